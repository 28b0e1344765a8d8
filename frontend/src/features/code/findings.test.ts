import { Text } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { describe, expect, it } from 'vitest';
import type { PythonFinding } from '@/api/python';
import type { CodeFinding } from '@/store/language';
import { isOf, lintMarks, servedMark } from './findings';

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

  it('is at its place, which counts from 0', () => {
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

it('recognises findings of this text, whatever its line ends', () => {
  expect(isOf(doc, { text: 'import os\r\nx = 1' })).toBe(true);
  expect(isOf(doc, { text: 'import os' })).toBe(false);
  expect(isOf(doc, undefined)).toBe(false);
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
  const syntax: CodeFinding = {
    from: { line: 0, character: 0 },
    to: { line: 0, character: 1 },
    severity: 'error',
    message: '',
    source: 'ty invalid-syntax',
  };
  const marks = (findings: readonly PythonFinding[], isServed = false, text = doc) =>
    lintMarks(text, {
      linted: { text: doc.toString(), findings },
      served: isServed ? [syntax] : [],
    });

  it('are at their places, under the name of ruff', () => {
    expect(marks([finding()])).toEqual([
      { from: 7, to: 9, severity: 'warning', message: 'unused', source: 'ruff F401' },
    ]);
    expect(marks([finding({ end: { line: 1, column: 1 } })])).toMatchObject([{ from: 7, to: 7 }]);
  });

  it('are absent without an answer, or for an older text', () => {
    expect(lintMarks(doc, {})).toEqual([]);
    expect(marks([finding()], false, Text.of(['import os']))).toEqual([]);
  });

  it('leave out syntax errors that the language server has found', () => {
    const found = [finding({ severity: 'error' }), finding()];
    expect(marks(found).map(({ severity }) => severity)).toEqual(['error', 'warning']);
    expect(marks(found, true).map(({ severity }) => severity)).toEqual(['warning']);
  });

  it('offer a fix', () => {
    const edits = [{ start: { line: 1, column: 1 }, end: { line: 2, column: 1 }, content: '' }];
    const [mark] = marks([finding({ fix: { message: 'Remove it', edits } })]);
    const view = new EditorView({ doc });
    const [fix] = mark?.actions ?? [];
    expect(fix?.name).toBe('Remove it');
    fix?.apply(view, 0, 0);
    expect(view.state.doc.toString()).toBe('x = 1');
  });
});
