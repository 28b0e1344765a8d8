import { Text } from '@codemirror/state';
import { describe, expect, it } from 'vitest';
import type { ShownProblem } from '@/store/project/problems';
import { findingMarks, problemMarks } from './marks';

const ranges = [
  { node: 'a', start: 2, open_end: 10, end: 30 },
  { node: 'b', start: 12, open_end: 20, end: 25 },
];

const problem = (node: string | null, severity: 'error' | 'warning' | 'note', hint = ''): ShownProblem => ({
  source: 'server',
  severity,
  node,
  code: 'BT0101',
  message: `about ${node ?? 'all'}`,
  hint,
});

const textOf = (shown: ShownProblem) =>
  shown.source === 'server' ? { message: shown.message, hint: shown.hint } : { message: '', hint: '' };

describe('problemMarks', () => {
  it('are at the start tags of their nodes', () => {
    const problems = [problem('b', 'error', 'Change it.'), problem('a', 'warning'), problem('a', 'note')];
    expect(problemMarks(100, ranges, problems, textOf)).toEqual([
      { from: 12, to: 20, severity: 'error', message: 'about b\nChange it.' },
      { from: 2, to: 10, severity: 'warning', message: 'about a' },
      { from: 2, to: 10, severity: 'info', message: 'about a' },
    ]);
  });

  it('leave out nodes that the text does not have, or does not have any more', () => {
    expect(problemMarks(100, ranges, [problem('x', 'error'), problem(null, 'error')], textOf)).toEqual([]);
    expect(problemMarks(19, ranges, [problem('b', 'error')], textOf)).toEqual([]);
    expect(problemMarks(20, ranges, [problem('b', 'error')], textOf)).toHaveLength(1);
  });
});

describe('findingMarks', () => {
  const doc = Text.of(['<root>', '  <Wrong/>', '</root>']);
  const at = (line?: number) => {
    const finding = { code: 'X1', severity: 'error' as const, message: 'bad', ...(line ? { line } : {}) };
    const [mark] = findingMarks(doc, [finding]);
    return mark && doc.sliceString(mark.from, mark.to);
  };

  it('are at their lines, or at the first', () => {
    expect(at(2)).toBe('<Wrong/>');
    expect(at()).toBe('<root>');
  });
});
