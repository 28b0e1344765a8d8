import { Text } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { describe, expect, it } from 'vitest';
import type { PythonFinding } from '@/api/python';
import { isToldBetter, lintMarks, servedMark } from './findings';

const doc = Text.of(['import os', 'x = 1']);

describe('servedMark', () => {
  const mark = (from: [number, number], to: [number, number]) => {
    const place = ([line, character]: [number, number]) => ({ line, character });
    return servedMark(doc, {
      from: place(from),
      to: place(to),
      severity: 'warning',
      message: 'unused',
      source: 'ty',
    });
  };

  it('is at its place, counted from 0', () => {
    expect(mark([0, 7], [0, 9])).toEqual({
      from: 7,
      to: 9,
      severity: 'warning',
      message: 'unused',
      source: 'ty',
    });
    expect(mark([0, 0], [1, 1])).toMatchObject({ from: 0, to: 11 });
  });

  it('ends with its line, and with the text', () => {
    expect(mark([0, 7], [0, 99])).toMatchObject({ from: 7, to: 9 });
    expect(mark([1, 0], [2, 0])).toMatchObject({ from: 10, to: 15 });
    expect(mark([9, 0], [0, 0])).toMatchObject({ from: 15, to: 15 });
  });
});

it.each([
  ['X0001', false, false],
  ['BT0001', false, true],
  ['BT0601', false, false],
  ['BT0601', true, true],
  ['BT0602', true, false],
])('leaves the finding %s (language server %s) to another: %s', (code, isServed, isBetter) => {
  expect(isToldBetter({ code, severity: 'error', message: '' }, isServed)).toBe(isBetter);
});

describe('lintMarks', () => {
  const finding = (more: Partial<PythonFinding> = {}): PythonFinding => ({
    code: 'F401',
    severity: 'warning',
    message: 'unused',
    start: { line: 1, column: 8 },
    end: { line: 1, column: 10 },
    fix: null,
    ...more,
  });
  const marks = (found: readonly PythonFinding[], isServed = false, text = doc) =>
    lintMarks(text, { doc, findings: found }, isServed);

  it('are at their places, under the name of ruff', () => {
    expect(marks([finding()])).toEqual([
      { from: 7, to: 9, severity: 'warning', message: 'unused', source: 'ruff F401' },
    ]);
    expect(marks([finding({ end: { line: 1, column: 1 } })])).toMatchObject([{ from: 7, to: 7 }]);
  });

  it('are none without an answer, or about an older text', () => {
    expect(lintMarks(doc, null, false)).toEqual([]);
    expect(marks([finding()], false, Text.of(['import os']))).toEqual([]);
  });

  it('leave errors to the language server where there is one', () => {
    const found = [finding({ severity: 'error' }), finding()];
    expect(marks(found).map(({ severity }) => severity)).toEqual(['error', 'warning']);
    expect(marks(found, true).map(({ severity }) => severity)).toEqual(['warning']);
  });

  it('fix what they are about', () => {
    const edits = [{ start: { line: 1, column: 1 }, end: { line: 2, column: 1 }, content: '' }];
    const [mark] = marks([finding({ fix: { message: 'Remove it', edits } })]);
    const view = new EditorView({ doc });
    const [fix] = mark?.actions ?? [];
    expect(fix?.name).toBe('Remove it');
    fix?.apply(view, 0, 0);
    expect(view.state.doc.toString()).toBe('x = 1');
  });
});
