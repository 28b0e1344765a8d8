import { screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { openSession, show, user, type FakeExecutor } from '../../../harness/testing';
import { ValueField } from './ValueField';

type Row = Parameters<typeof ValueField>[0]['row'];

let executor: FakeExecutor;
const sent = () => executor.sentAs('set_blackboard');

function open(type: string, value: unknown) {
  const row = { scope: 'Dock', key: 'x', type, value, preview: false, removed: false, changedAt: 1 };
  show(<ValueField row={row as Row} />);
  return screen.getByLabelText<HTMLInputElement>('Value of x');
}

beforeEach(async () => {
  executor = await openSession({ state: 'paused' });
});

describe('a value', () => {
  it('is written with Enter, and then shown as the executor has it', async () => {
    const field = open('int', 3);
    await user.clear(field);
    await user.type(field, '12');
    expect(sent()).toEqual([]);
    await user.keyboard('{Enter}');
    expect(sent()).toEqual([{ scope: 'Dock', key: 'x', value: 12 }]);
    await waitFor(() => expect(field).toHaveValue('3'));
  });

  it('is left as it was with Escape', async () => {
    const field = open('int', 3);
    await user.type(field, '4{Escape}');
    expect(field).toHaveValue('3');
    await user.tab();
    expect(sent()).toEqual([]);
  });

  it('that is the same is not written', async () => {
    const field = open('str', 'door');
    await user.type(field, 's{Backspace}{Enter}');
    expect(sent()).toEqual([]);
    await user.click(field);
    await user.keyboard('{Enter}');
    expect(sent()).toEqual([]);
  });

  it('that does not fit its type is not written, also when the field is left', async () => {
    const field = open('int', 3);
    await user.type(field, '.5{Enter}');
    expect(screen.getByText('x is a whole number, such as 5.')).toBeInTheDocument();
    await user.tab();
    expect(screen.getByText('x is a whole number, such as 5.')).toBeInTheDocument();
    expect(sent()).toEqual([]);
    await user.clear(field);
    expect(screen.queryByText('x is a whole number, such as 5.')).toBeNull();
    await user.type(field, '5');
    await user.tab();
    expect(sent()).toEqual([{ scope: 'Dock', key: 'x', value: 5 }]);
  });

  it('that is refused stays in the field, with the reason', async () => {
    executor.refuse('set_blackboard', 'It is read-only.', 'Write another.');
    const field = open('str', 'a');
    await user.type(field, 'b{Enter}');
    expect(await screen.findByText('It is read-only. Write another.')).toBeInTheDocument();
    expect(field).toHaveValue('ab');
    expect(field).toBeInvalid();
  });
});

describe('a boolean', () => {
  it('is chosen and written at once', async () => {
    const field = open('bool', true);
    expect(field).toHaveValue('true');
    expect([...field.querySelectorAll('option')].map(({ value }) => value)).toEqual(['true', 'false']);
    await user.selectOptions(field, 'false');
    expect(sent()).toEqual([{ scope: 'Dock', key: 'x', value: false }]);
  });

  it('that is refused stays chosen, with the reason', async () => {
    executor.refuse('set_blackboard', 'It is read-only.');
    const field = open('bool', true);
    await user.selectOptions(field, 'false');
    expect(await screen.findByText('It is read-only.')).toBeInTheDocument();
    expect(field).toHaveValue('false');
  });
});
