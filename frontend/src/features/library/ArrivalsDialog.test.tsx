import { screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Insertion } from '@/model/reuse';
import { bring } from '@/store/dialogs/arrivals';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { openProject, show, user } from '../../../harness/testing';
import { ArrivalsDialog } from './ArrivalsDialog';

const take = vi.fn<(plan: Insertion) => void>();
const taken = () => take.mock.calls[0]?.[0];
const row = (path: string) => within(screen.getByTestId(`arrival-${path}`));

beforeEach(() => {
  take.mockReset();
  openProject({
    trees: { Main: { r: { type: 'Sequence' } } },
    texts: { 'actions/Turn.py': 'class Turn: mine', 'actions/Same.py': 'class Same: ...' },
  });
  show(<ArrivalsDialog />);
});

async function open() {
  bring({
    act: 'paste',
    name: 'Rover',
    needs: ['trees/Dock.json', 'actions/Turn.py', 'actions/Same.py'],
    sources: {
      'trees/Dock.json': oneBlock('Dock', 'Turn'),
      'actions/Turn.py': 'class Turn: theirs',
      'actions/Same.py': 'class Same: ...',
    },
    take,
  });
  return within(await screen.findByRole('dialog', { name: 'Paste from Rover' }));
}

describe('what comes', () => {
  it('is listed by kind, with what becomes of it', async () => {
    const dialog = await open();
    expect(dialog.getByRole('region', { name: '1 tree' })).toBeInTheDocument();
    expect(dialog.getByRole('region', { name: '2 actions' })).toBeInTheDocument();
    expect(row('trees/Dock.json').getByText('New')).toBeInTheDocument();
    expect(row('actions/Same.py').getByText('Already here')).toBeInTheDocument();
    expect(
      row('actions/Turn.py').getByText('Your Turn stays; the incoming one is named Turn2.'),
    ).toBeInTheDocument();
  });

  it('is taken under other names unless the user chooses', async () => {
    await open();
    await user.click(screen.getByTestId('take-arrivals'));
    expect(Object.keys(taken()?.files ?? {})).toEqual(['trees/Dock.json', 'actions/Turn2.py']);
    expect(screen.queryByTestId('take-arrivals')).toBeNull();
  });

  it.each([
    ['Keep mine', /stays, and the blocks use it/, ['trees/Dock.json']],
    ['Replace mine', /is replaced/, ['trees/Dock.json', 'actions/Turn.py']],
  ])('may clash: %s', async (choice, says, written) => {
    await open();
    await user.click(screen.getByRole('radio', { name: choice }));
    expect(row('actions/Turn.py').getByText(says)).toBeInTheDocument();
    await user.click(screen.getByTestId('take-arrivals'));
    expect(Object.keys(taken()?.files ?? {})).toEqual(written);
  });

  it('is looked at before it is taken', async () => {
    await open();
    await user.click(screen.getByRole('button', { name: 'Turn' }));
    expect(await screen.findByRole('textbox', { name: 'actions/Turn.py, incoming' })).toHaveTextContent(
      'theirs',
    );
    expect(screen.getByRole('textbox', { name: 'actions/Turn.py in this project' })).toHaveTextContent(
      'mine',
    );
    await user.click(screen.getByRole('button', { name: 'Same' }));
    expect(await screen.findByTestId('action-source')).toHaveTextContent('class Same: ...');
    await user.click(screen.getByRole('button', { name: 'Dock' }));
    expect(row('trees/Dock.json').getByRole('button')).toHaveAttribute('aria-expanded', 'true');
  });

  it('is not taken when the user closes', async () => {
    const dialog = await open();
    await user.click(dialog.getAllByRole('button', { name: 'Cancel' }).at(-1)!);
    expect(screen.queryByTestId('take-arrivals')).toBeNull();
    expect(take).not.toHaveBeenCalled();
  });
});

it('asks nothing where all is here, or the library brings only new files', () => {
  const same = { needs: ['actions/Same.py'], sources: { 'actions/Same.py': 'class Same: ...' } };
  bring({ act: 'paste', name: 'Rover', ...same, take });
  bring({ act: 'insert', name: 'Go', needs: ['actions/Go.py'], sources: { 'actions/Go.py': '' }, take });
  expect(take).toHaveBeenCalledTimes(2);
  expect(screen.queryByTestId('take-arrivals')).toBeNull();
});

it('never replaces the tree that the user inserts into', async () => {
  useProjectStore.getState().setActiveTree('Main');
  const sources = { 'trees/Main.json': oneBlock('Main', 'AlwaysSuccess') };
  bring({ act: 'paste', name: 'Rover', needs: Object.keys(sources), sources, take });
  await screen.findByTestId('take-arrivals');
  expect(screen.queryByRole('radio')).toBeNull();
  await user.click(screen.getByTestId('take-arrivals'));
  expect(taken()?.places).toEqual({ 'trees/Main.json': 'trees/Main2.json' });
});
