import { EditorView } from '@codemirror/view';
import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { XmlLink, type XmlSnapshot, type XmlState } from '@/store/xml/link';
import { action, openProject, port, show } from '../../../harness/testing';
import { XmlEditor } from './XmlEditor';

const TEXT = '<Sequence>\n  <Go _bts_id="g"/>\n</Sequence>';
const RANGES = [
  { node: 's', start: 0, open_end: 10, end: TEXT.length },
  { node: 'g', start: 13, open_end: 30, end: 30 },
];

const IN_STEP: XmlState = { kind: 'inStep', findings: [] };
const snapshotOf = (more: Partial<XmlSnapshot> = {}): XmlSnapshot => ({
  text: TEXT,
  ranges: RANGES,
  state: IN_STEP,
  isRestored: false,
  ...more,
});

let edited: string[];

function element(snapshot: XmlSnapshot, showsMetadata = false) {
  return <XmlEditor treeId="Main" link={link} snapshot={snapshot} showsMetadata={showsMetadata} />;
}

/** A link with a fixed text, which records the typed texts. */
class HeldLink extends XmlLink {
  override readonly get = () => snapshotOf();
  override edited(text: string): void {
    edited.push(text);
  }
}
let link: HeldLink;

const editor = () => {
  const view = EditorView.findFromDOM(screen.getByTestId('xml-editor'));
  if (!view) throw new Error('There is no editor.');
  return view;
};
const text = () => editor().state.doc.toString();
const chosen = () => [...editor().dom.querySelectorAll('.cm-chosenNode')].map((line) => line.textContent);
const selection = () => useProjectStore.getState().selection;

beforeEach(() => {
  edited = [];
  link = new HeldLink('p1', 'Main');
  openProject({
    trees: {
      Main: { s: { type: 'Sequence', children: ['g'] }, g: { type: 'Go' } },
      Other: { o: { type: 'Go' } },
    },
    actions: [action('Go', { ports: [port('goal', 'string', { required: true })] })],
  });
  useProjectStore.getState().setActiveTree('Main');
});

describe('XmlEditor', () => {
  it('passes on typed text, and nothing that came from the tree', () => {
    const { rerender } = show(element(snapshotOf()));
    rerender(element(snapshotOf({ text: '<Fallback/>', ranges: [] })));
    expect([text(), edited]).toEqual(['<Fallback/>', []]);
    act(() => editor().dispatch({ changes: { from: 0, insert: ' ' } }));
    expect(edited).toEqual([' <Fallback/>']);
  });

  it('keeps the cursor if the tree changes elsewhere', () => {
    const { rerender } = show(element(snapshotOf()));
    act(() => editor().dispatch({ selection: { anchor: 5 } }));
    rerender(element(snapshotOf({ text: TEXT.replace('Go', 'Turn') })));
    expect(editor().state.selection.main.head).toBe(5);
  });

  it('selects the node at the cursor on the canvas, while it has the focus', () => {
    show(element(snapshotOf()));
    act(() => editor().dispatch({ selection: { anchor: 15 } }));
    expect(selection()).toEqual([]);
    act(() => editor().focus());
    act(() => editor().dispatch({ selection: { anchor: 16 } }));
    expect(selection()).toEqual(['g']);
    act(() => editor().dispatch({ selection: { anchor: 2 } }));
    expect(selection()).toEqual(['s']);
  });

  it('marks the selection of the canvas of its tree', () => {
    show(element(snapshotOf()));
    act(() => useProjectStore.getState().select('Main', ['g']));
    expect(chosen()).toEqual(['  <Go/>']);
    act(() => useProjectStore.getState().setActiveTree('Other'));
    expect(chosen()).toEqual([]);
  });

  it('shows the problems of the tree at its nodes, while text and tree agree', () => {
    const marks = () =>
      [...editor().dom.querySelectorAll('.cm-lintRange-error')].map(({ textContent }) => textContent);
    const { rerender } = show(element(snapshotOf()));
    expect(marks()).toEqual(['<Go/>']);
    rerender(element(snapshotOf({ state: { kind: 'reading' } })));
    expect(marks()).toEqual([]);
    const finding = { code: 'X1', severity: 'error' as const, message: 'bad', line: 1 };
    rerender(element(snapshotOf({ state: { kind: 'broken', findings: [finding] } })));
    expect(marks()).toEqual(['<Sequence>']);
  });

  it('cannot be edited by a viewer', () => {
    useProjectStore.setState({ role: 'viewer' });
    show(element(snapshotOf()));
    expect(editor().state.readOnly).toBe(true);
  });
});
