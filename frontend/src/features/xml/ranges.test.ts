import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { describe, expect, it, onTestFinished } from 'vitest';
import { dimMetadata, hiddenMetadata, nodeAt, nodeRanges, rangesOf, setRanges, setSelected } from './ranges';

const TEXT = '<root>\n  <Sequence\n    name="a">\n    <Go/>\n  </Sequence>\n</root>';
const at = (words: string) => TEXT.indexOf(words);

const ranges = [
  { node: 's', start: at('<Sequence'), open_end: at('<Go') - 5, end: at('</Sequence>') + 11 },
  { node: 'g', start: at('<Go'), open_end: at('<Go') + 5, end: at('<Go') + 5 },
];

function open(doc = TEXT, extensions = nodeRanges) {
  const parent = document.body.appendChild(document.createElement('div'));
  const view = new EditorView({ parent, state: EditorState.create({ doc, extensions }) });
  onTestFinished(() => {
    view.destroy();
    parent.remove();
  });
  return view;
}

const marked = (view: EditorView) =>
  [...view.dom.querySelectorAll('.cm-chosenNode')].map((line) => line.textContent);

describe('nodeAt', () => {
  it.each([
    [0, null],
    [at('<Sequence') - 1, null],
    [at('<Sequence'), 's'],
    [at('name'), 's'],
    [at('<Go'), 'g'],
    [at('<Go') + 5, 'g'],
    [at('<Go') + 6, 's'],
    [at('</Sequence>') + 11, 's'],
    [at('</Sequence>') + 12, null],
  ])('finds the innermost node at %s', (place, node) => {
    expect(nodeAt(ranges, place)).toBe(node);
    expect(nodeAt([...ranges].reverse(), place)).toBe(node);
  });
});

describe('nodeRanges', () => {
  it('move with the text', () => {
    const view = open();
    expect(rangesOf(view)).toEqual([]);
    view.dispatch({ effects: setRanges.of(ranges) });
    expect(rangesOf(view)).toBe(ranges);
    view.dispatch({ changes: { from: 0, insert: 'xxx' } });
    expect(rangesOf(view)).toEqual(
      ranges.map(({ node, start, open_end, end }) => ({
        node,
        start: start + 3,
        open_end: open_end + 3,
        end: end + 3,
      })),
    );
  });

  it('do not grow at their ends', () => {
    const view = open('<Go/>');
    view.dispatch({ effects: setRanges.of([{ node: 'g', start: 0, open_end: 5, end: 5 }]) });
    view.dispatch({
      changes: [
        { from: 5, insert: 'after' },
        { from: 0, insert: 'before' },
      ],
    });
    expect(rangesOf(view)).toEqual([{ node: 'g', start: 6, open_end: 11, end: 11 }]);
  });

  it('mark the lines of the start tags of selected nodes', () => {
    const view = open();
    view.dispatch({ effects: setRanges.of(ranges) });
    expect(marked(view)).toEqual([]);
    view.dispatch({ effects: setSelected.of(new Set(['s'])) });
    expect(marked(view)).toEqual(['  <Sequence', '    name="a">']);
    view.dispatch({ effects: setSelected.of(new Set(['g', 's'])) });
    expect(marked(view)).toEqual(['  <Sequence', '    name="a">', '    <Go/>']);
    view.dispatch({ effects: setSelected.of(new Set()) });
    expect(marked(view)).toEqual([]);
  });

  it('mark nothing beyond the text', () => {
    const view = open('<Go/>');
    view.dispatch({ effects: [setRanges.of(ranges), setSelected.of(new Set(['s']))] });
    expect(marked(view)).toEqual([]);
  });
});

describe('metadata', () => {
  const text = '<Go _bts_id="a" name="b" _bts_at="1,2"/>';
  const shown = (view: EditorView) => view.dom.querySelector('.cm-line')?.textContent;

  it('is hidden, and skipped by the cursor', () => {
    const view = open(text, hiddenMetadata as typeof nodeRanges);
    expect(shown(view)).toBe('<Go name="b"/>');
    const ranges = view.state.facet(EditorView.atomicRanges).map((of) => of(view));
    const found: number[][] = [];
    for (const set of ranges) set.between(0, text.length, (from, to) => void found.push([from, to]));
    expect(found).toEqual([
      [3, 15],
      [24, 38],
    ]);
    view.dispatch({ changes: { from: 0, to: 3, insert: '<Turn _bts_x="1"' } });
    expect(shown(view)).toBe('<Turn name="b"/>');
  });

  it('is dimmed, and reached by the cursor', () => {
    const view = open(text, dimMetadata as typeof nodeRanges);
    expect(shown(view)).toBe(text);
    expect([...view.dom.querySelectorAll('.cm-metadata')].map(({ textContent }) => textContent)).toEqual([
      ' _bts_id="a"',
      ' _bts_at="1,2"',
    ]);
    expect(view.state.facet(EditorView.atomicRanges)).toEqual([]);
  });
});
