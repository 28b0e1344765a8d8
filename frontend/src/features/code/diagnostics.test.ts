import { Text } from '@codemirror/state';
import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import type { Fault } from '@/generated/messages';
import { marksFor } from './diagnostics';

const doc = Text.of(['class Go:', '    def update(self)', '        return 1']);
const PATH = 'actions/Go.py';

const diagnostic = (more: Partial<Diagnostic>): Diagnostic => ({
  code: 'X0301',
  severity: 'error',
  message: 'expected ":"',
  file: PATH,
  ...more,
});

const fault = (more: Partial<Fault>): Fault => ({
  kind: 'exception',
  message: 'ZeroDivisionError: division by zero',
  hint: '',
  node_id: 'n1',
  tree_id: 'MainTree',
  node_path: 'go',
  file: PATH,
  line: 3,
  traceback: '',
  ...more,
});

const marked = (more: Partial<Diagnostic>) => {
  const [mark] = marksFor(doc, PATH, [diagnostic(more)], []);
  return mark && doc.sliceString(mark.from, mark.to);
};

describe('marks of findings', () => {
  it.each([
    [{ line: 2, column: 5 }, 'def'],
    [{ line: 2, column: 9 }, 'update'],
    [{ line: 1, column: 9 }, ':'],
    [{ line: 3 }, 'return 1'],
    [{ line: 3, column: 0 }, 'return 1'],
    [{ line: 99 }, 'return 1'],
    [{ line: 1, column: 99 }, ''],
    [{ line: 1, column: null }, 'class Go:'],
  ])('at %j are on “%s”', (place, words) => {
    expect(marked(place)).toBe(words);
  });

  it('say what is wrong, and how to fix it', () => {
    const items = [
      diagnostic({ line: 1 }),
      diagnostic({ line: 1, severity: 'warning', hint: 'Add it.' }),
      diagnostic({ line: 1, severity: 'note' }),
    ];
    expect(marksFor(doc, PATH, items, [])).toMatchObject([
      { severity: 'error', message: 'expected ":"', source: 'X0301' },
      { severity: 'warning', message: 'expected ":"\nAdd it.' },
      { severity: 'info' },
    ]);
  });

  it('leave out other files, and findings without a line', () => {
    expect(
      marksFor(doc, PATH, [diagnostic({ file: 'actions/Other.py', line: 1 }), diagnostic({})], []),
    ).toEqual([]);
  });
});

describe('marks of a run', () => {
  it('are on the line that raised', () => {
    const [mark, ...others] = marksFor(doc, PATH, [], [fault({ hint: 'Check it.' })]);
    expect(mark).toEqual({
      from: 39,
      to: 47,
      severity: 'error',
      message: 'ZeroDivisionError: division by zero\nCheck it.',
      markClass: 'cm-faultLine',
    });
    expect(others).toEqual([]);
  });

  it('leave out other files, and faults without a line', () => {
    expect(marksFor(doc, PATH, [], [fault({ line: 0 }), fault({ file: 'actions/Other.py' })])).toEqual([]);
  });
});
