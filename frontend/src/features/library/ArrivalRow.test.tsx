import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Arrival } from '@/model/reuse';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { openProject, show, user } from '../../../harness/testing';
import { ArrivalRow } from './ArrivalRow';

const onChoose = vi.fn();
const TURN = 'actions/Turn.py';

beforeEach(() => {
  onChoose.mockReset();
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts: { [TURN]: 'class Turn: mine' } });
});

const open = (path: string, state: Arrival['state'], source = 'class Turn: theirs', place = path) =>
  show(<ArrivalRow arrival={{ path, place, state }} source={source} onChoose={onChoose} />);

describe('a file that comes', () => {
  it.each([
    ['new', 'New'],
    ['same', 'Already here'],
  ] as const)('offers no choice where none is needed: %s', (state, says) => {
    open('actions/Go.py', state);
    expect(screen.getByText(says)).toBeInTheDocument();
    expect(screen.queryByRole('radio')).toBeNull();
  });

  it('offers what can be done where its name is taken', async () => {
    open(TURN, 'rename', undefined, 'actions/Turn2.py');
    expect(screen.getByRole('radiogroup', { name: 'Another Turn is here' })).toBeInTheDocument();
    expect(screen.getAllByRole('radio').map((each) => (each as HTMLInputElement).value)).toEqual([
      'keep',
      'rename',
      'replace',
    ]);
    await user.click(screen.getByRole('radio', { name: 'Keep mine' }));
    expect(onChoose).toHaveBeenCalledExactlyOnceWith('keep');
  });

  it('shows its code, or both where its name is taken', async () => {
    const { unmount } = open('actions/Go.py', 'new', 'class Go: ...');
    await user.click(screen.getByRole('button', { name: 'Go' }));
    expect(await screen.findByTestId('action-source')).toHaveTextContent('class Go: ...');
    unmount();
    open(TURN, 'replace');
    await user.click(screen.getByRole('button', { name: 'Turn' }));
    expect(await screen.findByRole('textbox', { name: `${TURN}, incoming` })).toHaveTextContent('theirs');
  });

  it('shows a new tree as a picture', async () => {
    const { container } = open('trees/Dock.json', 'new', oneBlock('Dock', 'AlwaysSuccess'));
    await user.click(screen.getByRole('button', { name: 'Dock' }));
    await vi.waitFor(() => expect(container.querySelectorAll('svg rect').length).toBeGreaterThan(0));
  });

  it('says that the tree into which it comes stays', () => {
    useProjectStore.getState().setActiveTree('Main');
    open('trees/Main.json', 'rename', oneBlock('Main', 'AlwaysSuccess'), 'trees/Main2.json');
    expect(
      screen.getByText('You are inserting into Main, so the incoming one is named Main2.'),
    ).toBeInTheDocument();
    expect(screen.queryByRole('radio')).toBeNull();
  });
});
