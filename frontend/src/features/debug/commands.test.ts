import { notifications } from '@mantine/notifications';
import { afterEach, expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { useCommandTable } from '@/commands/registry';
import { bindShortcuts } from '@/commands/shortcuts';
import { registerRunCommands } from '@/features/run/commands';
import { toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { registerDebugCommands } from './commands';

const undo: (() => void)[] = [];
afterEach(() => {
  undo.splice(0).forEach((each) => each());
  vi.restoreAllMocks();
  useSessionStore.setState(initialSession);
  useBreakpoints.setState({ list: [], areOn: true });
});

function press(key: string, more: Partial<KeyboardEventInit> = {}): string[] {
  const ran: string[] = [];
  undo.push(registerRunCommands(), registerDebugCommands());
  for (const command of Object.values(useCommandTable.getState().commands)) {
    vi.spyOn(command, 'run').mockImplementation(() => void ran.push(command.id));
  }
  undo.push(bindShortcuts(window));
  window.dispatchEvent(new KeyboardEvent('keydown', { key, code: key, cancelable: true, ...more }));
  return ran;
}

const hold = () => useSessionStore.setState({ executor: 'held', introspection: { role: 'driver' } as never });

it.each([
  ['F5', {}, 'debug.continue'],
  ['F10', {}, 'debug.over'],
  ['F11', {}, 'debug.into'],
  ['F11', { shiftKey: true }, 'debug.out'],
  ['F10', { ctrlKey: true, shiftKey: true }, 'debug.tickBack'],
])('%s %o of a held tree is %s', (key, more, id) => {
  hold();
  expect(press(key, more)).toEqual([id]);
});

it.each([
  ['F5', 'run.run'],
  ['F10', 'run.step'],
])('%s of a running tree is %s', (key, id) => {
  useSessionStore.setState({ executor: 'application_running' });
  expect(press(key)).toEqual([id]);
});

it('a key takes a paused run one tick back, and a running one not', () => {
  useSessionStore.setState({ executor: 'paused', introspection: { role: 'driver' } as never });
  expect(press('F10', { ctrlKey: true, shiftKey: true })).toEqual(['debug.tickBack']);
  undo.splice(0).forEach((each) => each());
  useSessionStore.setState({ executor: 'application_running' });
  expect(press('F10', { ctrlKey: true, shiftKey: true })).toEqual([]);
});

it('a key switches all breakpoints off and on', () => {
  toggleBreakpoint('Main', 'a');
  expect(press('F9', { ctrlKey: true, shiftKey: true })).toEqual(['debug.switchBreakpoints']);
});

it.each([
  [
    'a live run',
    { executor: 'paused', repeatableRuns: ['a'], liveRuns: ['a'] },
    /A live run has no way back by one tick/,
  ],
  ['a running one', { executor: 'application_running' }, /pause the run first/],
] as const)('the key of one tick back says why %s cannot go back', (_, state, why) => {
  const show = vi.spyOn(notifications, 'show').mockReturnValue('');
  useSessionStore.setState({
    introspection: { role: 'driver' } as never,
    ...structuredClone(state),
  } as never);
  expect(press('F10', { ctrlKey: true, shiftKey: true })).toEqual([]);
  expect(show.mock.calls).toEqual([
    [expect.objectContaining({ message: expect.stringMatching(why) as string })],
  ]);
});

it('the key of one tick back says nothing where no program runs', () => {
  const show = vi.spyOn(notifications, 'show').mockReturnValue('');
  useSessionStore.setState({ executor: 'idle' });
  expect(press('F10', { ctrlKey: true, shiftKey: true })).toEqual([]);
  expect(show).not.toHaveBeenCalled();
});
