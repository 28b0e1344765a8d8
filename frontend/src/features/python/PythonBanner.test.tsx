import { act, screen } from '@testing-library/react';
import { afterEach, expect, it, onTestFinished } from 'vitest';
import '@/i18n/editorTexts';
import { registerCommands } from '@/commands/registry';
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
