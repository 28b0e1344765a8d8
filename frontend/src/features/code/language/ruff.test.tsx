import { history, undo } from '@codemirror/commands';
import { Text } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { screen } from '@testing-library/react';
import fc from 'fast-check';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { refusal } from '../../../../harness/requests';
import { fakeServer, show } from '../../../../harness/testing';
import { applyFix, changesBetween, formatPython, formatsOnSave, offsetOf, setFormatsOnSave } from './ruff';

const FORMAT = 'POST /python/format';
const editor = (doc: string) => new EditorView({ doc, extensions: history() });
const text = (view: EditorView) => view.state.doc.toString();

describe('formatsOnSave', () => {
  beforeEach(() => {
    localStorage.clear();
    onTestFinished(() => localStorage.clear());
  });

  it('is on until it is switched off', () => {
    expect(formatsOnSave()).toBe(true);
    setFormatsOnSave(false);
    expect(formatsOnSave()).toBe(false);
    setFormatsOnSave(true);
    expect(formatsOnSave()).toBe(true);
  });
});

describe('offsetOf', () => {
  const doc = Text.of(['ab', '🤖cd', 'e']);
  it.each([
    [1, 1, 0],
    [1, 3, 2],
    [1, 99, 2],
    [2, 1, 3],
    [2, 2, 5],
    [2, 3, 6],
    [3, 1, 8],
    [4, 1, 9],
    [0, 1, 0],
    [1, 0, 0],
  ])('line %s, column %s is at %s', (line, column, offset) => {
    expect(offsetOf(doc, { line, column })).toBe(offset);
  });
});

describe('changesBetween', () => {
  it('changes only what differs', () => {
    expect(changesBetween('one two three', 'one 2 three')).toEqual([{ from: 4, to: 7, insert: '2' }]);
    expect(changesBetween('same', 'same')).toEqual([]);
  });

  it('turns any text into any other', () => {
    const any = fc.string({ unit: fc.constantFrom('a', 'b', ' ', '\n'), maxLength: 30 });
    fc.assert(
      fc.property(any, any, (before, after) => {
        const view = new EditorView({ doc: before });
        view.dispatch({ changes: changesBetween(before, after) });
        expect(text(view)).toBe(after);
      }),
      { numRuns: 50 },
    );
  });
});

describe('formatPython', () => {
  it('formats as one step of undo', async () => {
    const { requests } = fakeServer({ [FORMAT]: { source: 'x = 1\ny = 2\n', findings: [] } });
    const view = editor('x=1\ny=2\n');
    await formatPython(view, 'actions/Go.py', 'asked');
    expect(text(view)).toBe('x = 1\ny = 2\n');
    expect(requests[0]?.body).toEqual({ source: 'x=1\ny=2\n', filename: 'actions/Go.py' });
    undo(view);
    expect(text(view)).toBe('x=1\ny=2\n');
  });

  it('leaves a text that has changed meanwhile', async () => {
    fakeServer({ [FORMAT]: { source: 'x = 1\n', findings: [] } });
    const view = editor('x=1\n');
    const formatted = formatPython(view, 'a.py', 'asked');
    view.dispatch({ changes: { from: 0, insert: '#' } });
    await formatted;
    expect(text(view)).toBe('#x=1\n');
  });

  it('reports why it failed, if the user asked for it', async () => {
    fakeServer({ [FORMAT]: refusal('A syntax error in line 1.') });
    show(<p />);
    const view = editor('x=(');
    await formatPython(view, 'a.py', 'asked');
    expect(await screen.findByText('A syntax error in line 1.')).toBeInTheDocument();
    expect(screen.getByText('Not formatted')).toBeInTheDocument();
    expect(text(view)).toBe('x=(');
  });

  it('leaves a text with a syntax error, and reports that', async () => {
    fakeServer({ [FORMAT]: { source: 'x=(', findings: [{}] } });
    show(<p />);
    const view = editor('x=(');
    await formatPython(view, 'a.py', 'asked');
    expect(await screen.findByText(/The file has a syntax error/)).toBeInTheDocument();
    expect(text(view)).toBe('x=(');
  });

  it.each([refusal('The formatter did not answer.'), { source: 'x=(', findings: [{}] }])(
    'is silent while saving',
    async (answer) => {
      fakeServer({ [FORMAT]: answer });
      show(<p />);
      await formatPython(editor('x=('), 'a.py', 'saving');
      expect(screen.queryByText('Not formatted')).toBeNull();
    },
  );
});

describe('applyFix', () => {
  const place = (line: number, column: number) => ({ line, column });
  const finding = {
    code: 'F401',
    severity: 'warning' as const,
    message: '',
    start: place(1, 1),
    end: place(1, 2),
    fix: {
      message: '',
      edits: [
        { start: place(1, 1), end: place(2, 1), content: '' },
        { start: place(2, 5), end: place(2, 6), content: '2' },
      ],
    },
  };

  it('applies all its edits', () => {
    const view = editor('import os\nx = 1');
    applyFix(view, view.state.doc, finding);
    expect(text(view)).toBe('x = 2');
  });

  it('leaves another text unchanged, and does nothing without edits', () => {
    const view = editor('import os\nx = 1');
    applyFix(view, Text.of(['import os']), finding);
    applyFix(view, view.state.doc, { ...finding, fix: null });
    expect(text(view)).toBe('import os\nx = 1');
  });
});
