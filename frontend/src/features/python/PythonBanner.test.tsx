import { act, screen } from '@testing-library/react';
import { afterEach, expect, it, onTestFinished } from 'vitest';
import '@/i18n/editorTexts';
import { registerCommands } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { usePython } from '@/store/python/stop';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { show, user, watchNavigation } from '../../../harness/testing';
import { PythonBanner } from './PythonBanner';

const frames = [{ id: 7, name: 'update', path: 'actions/Turn.py', line: 12 }];
const stop = { thread: 1, reason: 'breakpoint', text: '', frames, frame: 0, version: 1 };

afterEach(() =>
  act(() => {
    usePython.setState(usePython.getInitialState());
    useSessionStore.setState(initialSession);
  }),
);

it('says where the program is held and why, leads there, and steps', async () => {
  const { openFile } = watchNavigation();
  const commands = ['continue', 'over', 'into', 'out'].map((name) => `debug.${name}`);
  onTestFinished(
    registerCommands(commands.map((id) => ({ id, group: 'run', labelKey: id, run: () => undefined }))),
  );
  show(<PythonBanner />);
  expect(screen.queryByTestId('python-banner')).toBeNull();
  act(() => usePython.setState({ stop }));
  expect(screen.getByTestId('python-banner')).toHaveTextContent(
    'Held in update at actions/Turn.py:12 by a breakpoint.',
  );
  await user.click(screen.getByTestId('python-place'));
  expect(openFile).toHaveBeenCalledWith('actions/Turn.py', 12);
  expect(screen.getAllByRole('button')).toHaveLength(6);
  act(() => usePython.setState({ stop: { ...stop, reason: 'exception', text: 'ValueError: too many' } }));
  expect(screen.getByTestId('python-banner')).toHaveTextContent('ValueError: too many');
});

it('says to others that the program is held', () => {
  show(<PythonBanner />);
  act(() => useSessionStore.setState({ executor: 'held', held: null }));
  expect(screen.getByTestId('python-banner')).toHaveTextContent('by the window that controls the session');
  expect(screen.queryAllByRole('button')).toEqual([]);
});

it('names the block whose code is held, with its place, and leads to it', async () => {
  const node = (uid: number, parent: number, name: string) => ({
    ...{ uid, parent, name, path: name, node_id: `n${uid}`, tree_id: 'Main', kind: '', type: 'Wiggle' },
  });
  const tree = [node(1, 0, 'Sequence'), node(2, 1, 'Wiggle'), node(3, 1, 'Wiggle')];
  usePython.setState({ stop });
  const hold = { uid: 3, path: [1, 3], tick: 4, statuses: [] };
  useSessionStore.setState({ executor: 'held', tree, heldInPython: hold });
  show(<PythonBanner />);
  const block = screen.getByTestId('python-block');
  expect(block).toHaveTextContent('in “Wiggle”, child 2 of 2 of “Sequence”');
  await user.click(block);
  expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'n3' });
  act(() => useSessionStore.setState({ heldInPython: { ...hold, uid: 1 } }));
  expect(screen.getByTestId('python-block')).toHaveTextContent('in “Sequence”, the root');
});
