import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { connectedClient } from '../../../../harness/languageServer';
import { openProject } from '../../../../harness/testing';
import { countOf, groupPlaces, openPlace } from './places';
import { sourceUriOf, uriOf } from './uris';
import { ProjectWorkspace } from './workspace';

const GO = 'actions/Go.py';
const NODE = sourceUriOf('packages/rclpy/node.py');
const range = (line: number, start: number, end: number) => ({
  start: { line, character: start },
  end: { line, character: end },
});
const open = () =>
  connectedClient(
    { workspace: (of) => new ProjectWorkspace(of, () => undefined) },
    { 'studio/source': { text: 'class Node:\n    pass' } },
  );

beforeEach(() => {
  openProject({ texts: { [GO]: 'import x\nx.go(x)\n', 'actions/A.py': 'x = 1' } });
});

it('groups places by file, in order, with their lines, and those of the project first', async () => {
  const { client } = await open();
  const groups = await groupPlaces(client, [
    { uri: NODE, range: range(0, 6, 10) },
    { uri: uriOf(GO), range: range(1, 5, 6) },
    { uri: uriOf(GO), range: range(1, 0, 1) },
    {
      uri: uriOf('actions/A.py'),
      range: { start: { line: 0, character: 0 }, end: { line: 3, character: 0 } },
    },
    { uri: 'file:///elsewhere/b.py', range: range(7, 0, 1) },
  ]);
  expect(groups.map(({ name, isOutside }) => [name, isOutside])).toEqual([
    ['actions/A.py', false],
    [GO, false],
    ['file:///elsewhere/b.py', true],
    ['rclpy/node.py', true],
  ]);
  expect(groups.map(({ places }) => places.map(({ text, from, to }) => [text, from, to]))).toEqual([
    [['x = 1', 0, 5]],
    [
      ['x.go(x)', 0, 1],
      ['x.go(x)', 5, 6],
    ],
    [['', 0, 1]],
    [['class Node:', 6, 10]],
  ]);
  expect(countOf(groups)).toBe(5);
});

it('selects a place in its editor, as far as its text still has it', async () => {
  const { client } = await open();
  const parent = document.body.appendChild(document.createElement('div'));
  const view = new EditorView({
    parent,
    state: EditorState.create({ doc: 'import x\nx.go(x)\n', extensions: client.plugin(uriOf(GO), 'python') }),
  });
  onTestFinished(() => {
    view.destroy();
    parent.remove();
  });
  const place = { uri: uriOf(GO), line: 1, from: 5, to: 6, text: '' };
  await openPlace(client, place);
  expect(view.state.selection.main).toMatchObject({ anchor: 14, head: 15 });
  expect(view.hasFocus).toBe(true);
  await openPlace(client, { ...place, line: 99, from: 3, to: 9 });
  expect(view.state.selection.main).toMatchObject({ anchor: 17, head: 17 });
  await openPlace(client, { ...place, uri: uriOf('actions/Gone.py') });
  expect(view.state.selection.main.head).toBe(17);
});
