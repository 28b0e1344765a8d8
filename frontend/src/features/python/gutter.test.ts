import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { changeLine, toggleLine, useLines } from '@/store/python/lines';
import { usePython } from '@/store/python/stop';
import { nameAround, pythonBreakpoints } from './gutter';

const PATH = 'actions/Turn.py';
let view: EditorView;

const editor = (path: string) =>
  new EditorView({
    parent: document.body,
    state: EditorState.create({ doc: 'one\ntwo\nthree\nfour', extensions: pythonBreakpoints(path) }),
  });

beforeEach(() => {
  useLines.setState({ list: [], exceptions: [], watches: [] });
  useBreakpoints.setState({ areOn: true });
  view = editor(PATH);
  onTestFinished(() => {
    view.destroy();
    usePython.setState(usePython.getInitialState());
  });
});

const looks = () =>
  [...view.dom.querySelectorAll<HTMLElement>('.cm-breakpoint:not([title=""])')].map(
    (dot) => dot.dataset['look'],
  );
const lines = () => useLines.getState().list.map(({ line }) => line);
const press = (key: string) =>
  view.contentDOM.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));

it('sets and removes a breakpoint at the line of the cursor by F9', () => {
  view.dispatch({ selection: { anchor: 5 } });
  press('F9');
  expect(lines()).toEqual([2]);
  expect(looks()).toEqual(['on']);
  press('F9');
  expect([lines(), looks()]).toEqual([[], []]);
});

it.each(['cm-breakpoints', 'cm-lineNumbers'])(
  'sets a breakpoint by a press in %s, with the first button alone',
  (gutter) => {
    const press = (button: number) =>
      view.dom
        .querySelector(`.${gutter}`)!
        .dispatchEvent(new MouseEvent('mousedown', { button, bubbles: true, cancelable: true }));
    press(2);
    expect(lines()).toEqual([]);
    press(0);
    expect(lines()).toHaveLength(1);
  },
);

it('shows breakpoints that are conditional, log, cannot hold, or are off', () => {
  [1, 2, 3, 4].forEach((line) => toggleLine(PATH, line));
  toggleLine('actions/Go.py', 1);
  changeLine(PATH, 1, { condition: 'x' });
  changeLine(PATH, 2, { log: 'x' });
  changeLine(PATH, 4, { on: false });
  usePython.setState({ problems: { [`${PATH}:3`]: 'No code here.' } });
  expect(looks()).toEqual(['plain', 'log', 'unsure', 'off']);
  expect(view.dom.querySelector('[data-look=unsure]')).toHaveAttribute('title', 'No code here.');
  useBreakpoints.setState({ areOn: false });
  expect(looks()).toEqual(['off', 'off', 'off', 'off']);
});

it('says that the debugger does not reach launch nodes', () => {
  view.destroy();
  view = editor('launch/talker.py');
  toggleLine('launch/talker.py', 2);
  expect(looks()).toEqual(['unsure']);
  expect(view.dom.querySelector('[data-look=unsure]')).toHaveAttribute(
    'title',
    expect.stringMatching(/of its own/),
  );
});

it('moves breakpoints with the text', async () => {
  toggleLine(PATH, 2);
  toggleLine(PATH, 4);
  view.dispatch({ changes: { from: 4, insert: 'new\n' } });
  await vi.waitFor(() => expect(lines()).toEqual([3, 5]));
  view.dispatch({ changes: { from: 4, to: 8 } });
  await vi.waitFor(() => expect(lines()).toEqual([2, 4]));
});

it('marks the line at which the program is stopped', () => {
  const frames = [{ id: 1, name: 'update', path: PATH, line: 3 }];
  const stop = { thread: 1, reason: 'step', text: '', frames, frame: 0, version: 1 };
  usePython.setState({ stop });
  expect(view.dom.querySelector('.cm-stoppedLine')).toHaveTextContent('three');
  usePython.setState({ stop: { ...stop, frames: [{ ...frames[0]!, path: 'actions/Go.py' }] } });
  expect(view.dom.querySelector('.cm-stoppedLine')).toBeNull();
});

it('is for Python alone', () => {
  expect(pythonBreakpoints('notes.md')).toEqual([]);
});

it.each([
  ['a = self.scan.ranges', 5, 'self'],
  ['a = self.scan.ranges', 11, 'self.scan'],
  ['a = self.scan.ranges', 19, 'self.scan.ranges'],
  ['a = self.scan.ranges', 3, null],
  ['números[0]', 2, 'números'],
])('finds the name in %s at %i', (text, at, name) => {
  expect(nameAround(text, at)?.name ?? null).toBe(name);
});
