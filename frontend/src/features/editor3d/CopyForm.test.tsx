import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { write } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import { CopyForm } from './CopyForm';

const ITEMS = [
  { id: 'template', name: 'Two wheels', description: 'Ours.' },
  { id: 'rover', name: 'Rover', description: 'Six wheels.' },
];

function form(more: Partial<Parameters<typeof CopyForm>[0]> = {}) {
  const onCreate = vi.fn(() => Promise.resolve());
  const onCancel = vi.fn();
  show(
    <CopyForm
      items={ITEMS}
      first="rover"
      taken={new Set(['mine'])}
      words={{ hint: 'Start somewhere.', taken: 'It is taken', use: 'Use it' }}
      testId="copy"
      onCreate={onCreate}
      onCancel={onCancel}
      {...more}
    />,
  );
  return { onCreate, onCancel, name: screen.getByTestId('copy-name'), ok: screen.getByTestId('copy-ok') };
}

describe('CopyForm', () => {
  it('shows the initial choice first, selected, with a free name', async () => {
    const { name } = form();
    expect(screen.getByText('Start somewhere.')).toBeInTheDocument();
    expect(screen.getAllByRole('radio').map((radio) => (radio as HTMLInputElement).value)).toEqual([
      'rover',
      'template',
    ]);
    expect(screen.getByRole('radio', { name: /Rover/ })).toBeChecked();
    expect(name).toHaveValue('my_rover');
    await waitFor(() => expect(name).toHaveFocus());
  });

  it('names a copy of the template `robot`, with a number if that is taken', () => {
    expect(form({ first: 'template', taken: new Set(['my_robot', 'my_robot_2']) }).name).toHaveValue(
      'my_robot_3',
    );
  });

  it('follows the choice until a name is typed', async () => {
    const { name } = form();
    await user.click(screen.getByRole('radio', { name: /Two wheels/ }));
    expect(name).toHaveValue('my_robot');
    await user.clear(name);
    await user.type(name, 'own');
    await user.click(screen.getByRole('radio', { name: /Rover/ }));
    expect(name).toHaveValue('own');
  });

  it('creates what was chosen', async () => {
    const { onCreate, name } = form();
    await user.click(screen.getByRole('switch', { name: 'Use it' }));
    await write(name, 'second');
    expect(onCreate).toHaveBeenCalledExactlyOnceWith('rover', 'second', false);
  });

  it.each([
    ['1st', 'Letters, digits, _ and - only; the first is a letter'],
    ['a b', 'Letters, digits, _ and - only; the first is a letter'],
    ['MINE', 'It is taken'],
  ])('refuses the name %s', async (wish, reason) => {
    const { onCreate, name, ok } = form();
    await write(name, wish);
    expect(screen.getByText(reason)).toBeInTheDocument();
    expect(ok).toBeDisabled();
    expect(onCreate).not.toHaveBeenCalled();
    await write(name, '_own-1');
    expect(screen.queryByText(reason)).toBeNull();
    expect(onCreate).toHaveBeenCalledWith('rover', '_own-1', true);
  });

  it('creates it once, and reports why it failed', async () => {
    let fail: (error: Error) => void = () => undefined;
    const onCreate = vi.fn(
      () =>
        new Promise<void>((_, reject) => {
          fail = reject;
        }),
    );
    const { name, ok } = form({ onCreate });
    await user.type(name, '{Enter}');
    await user.type(name, '{Enter}');
    expect(onCreate).toHaveBeenCalledOnce();
    expect(ok).toHaveAttribute('data-loading', 'true');
    expect(screen.queryByRole('alert')).toBeNull();
    fail(new Error('No room.'));
    expect(await screen.findByRole('alert')).toHaveTextContent('No room.');
    expect(ok).not.toHaveAttribute('data-loading');
    await user.click(ok);
    expect(onCreate).toHaveBeenCalledTimes(2);
    expect(screen.queryByRole('alert')).toBeNull();
  });

  it('closes by Cancel', async () => {
    const { onCancel } = form();
    await user.click(screen.getByRole('button', { name: 'Cancel' }));
    expect(onCancel).toHaveBeenCalledOnce();
  });
});
