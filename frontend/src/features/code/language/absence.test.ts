import { EditorState } from '@codemirror/state';
import { EditorView, runScopeHandlers } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { afterEach, expect, it, onTestFinished, vi } from 'vitest';
import { useLanguageStore } from '@/store/language';
import { absenceKeys } from './absence';

function press(path: string, key: string, shiftKey = false): boolean {
  const view = new EditorView({ state: EditorState.create({ doc: 'x', extensions: absenceKeys(path) }) });
  onTestFinished(() => view.destroy());
  return runScopeHandlers(view, new KeyboardEvent('keydown', { key, shiftKey }), 'editor');
}

afterEach(() => {
  useLanguageStore.setState({ state: { kind: 'off' } });
  vi.restoreAllMocks();
});

it.each([
  [{ kind: 'failed', reason: 'too many', willRetry: false }, 'No Python help: too many'],
  [{ kind: 'starting' }, 'Python help is starting…'],
  [{ kind: 'waiting', before: 2, isOwn: false }, 'Python help waits for a place: 2 editors are before yours'],
  [
    { kind: 'waiting', before: 0, isOwn: true },
    'Python help waits: close another page of yours with Python, or wait until it is idle',
  ],
] as const)('says why a key has no effect while the server is %o', (state, message) => {
  const show = vi.spyOn(notifications, 'show');
  useLanguageStore.setState({ state });
  expect(press('actions/Go.py', 'F2')).toBe(true);
  expect(press('actions/Go.py', 'F12')).toBe(true);
  expect(press('actions/Go.py', 'F12', true)).toBe(true);
  expect(show.mock.calls.map(([shown]) => shown.message)).toEqual([message, message, message]);
});

it('leaves the keys to their commands while the server runs, and in other files', () => {
  const show = vi.spyOn(notifications, 'show');
  expect(press('notes.md', 'F2')).toBe(false);
  useLanguageStore.setState({ state: { kind: 'ready' } });
  press('actions/Go.py', 'F2');
  expect(show).not.toHaveBeenCalled();
});
