import { EditorState, Text } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { expect, it, onTestFinished } from 'vitest';
import { callOf, FORWARD } from '../../../../harness/tickSource';
import { lineMarks, ranLines, wordsOf } from './marks';

it('counts the lines of all calls of the file, and takes the values of the chosen one', () => {
  const chosen = callOf();
  const other = callOf({ lines: [{ line: 4, times: 5, values: [{ name: 'total', text: '9' }] }] });
  const elsewhere = callOf({ file: 'actions/Turn.py', lines: [{ line: 1, times: 1, values: [] }] });
  const marks = lineMarks([other, chosen, elsewhere], chosen);
  expect(marks.map(({ line, times }) => [line, times])).toEqual([
    [3, 3],
    [4, 7],
    [5, 1],
    [6, 1],
    [8, 1],
  ]);
  expect(wordsOf(marks[1]?.values ?? [])).toBe('total = 1');
  expect(lineMarks([chosen, other], chosen)[1]?.values).toEqual([{ name: 'total', text: '1' }]);
});

const call = callOf();

function shown(marks = lineMarks([call], call)) {
  const doc = Text.of(FORWARD.split('\n'));
  const view = new EditorView({ state: EditorState.create({ doc, extensions: [ranLines(doc, marks)] }) });
  onTestFinished(() => view.destroy());
  return view.dom;
}

it('marks the lines that ran, with how often, and what changed', () => {
  const dom = shown();
  const ran = [...dom.querySelectorAll('.cm-ran')].map((line) => line.textContent);
  expect(ran).toHaveLength(5);
  expect(ran[1]).toBe('            total = steptotal = 1');
  expect(ran.some((line) => line.includes('return None'))).toBe(false);
  expect(dom.querySelector('.cm-ranTimes')?.textContent).toContain('3×');
});

it('leaves out lines that the text has not', () => {
  const line = (number: number) => ({ line: number, times: 1, values: [] });
  expect(shown([line(0), line(1), line(999)]).querySelectorAll('.cm-ran')).toHaveLength(1);
});
