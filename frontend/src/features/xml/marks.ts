import type { Diagnostic as Mark } from '@codemirror/lint';
import type { Text } from '@codemirror/state';
import type { NodeRange } from '@/api/trees';
import type { Diagnostic } from '@/api/types';
import type { ShownProblem } from '@/store/project/problems';
import type { ProblemText } from '@/ui/hooks/useProblemText';
import { marksFor } from '@/features/code/diagnostics';

const SEVERITY = { error: 'error', warning: 'warning', note: 'info' } as const;

/** Returns the problems of the tree, as marks at the start tags of their nodes. */
export function problemMarks(
  length: number,
  ranges: readonly NodeRange[],
  problems: readonly ShownProblem[],
  textOf: (problem: ShownProblem) => ProblemText,
): Mark[] {
  const places = new Map(ranges.map((range) => [range.node, range]));
  return problems.flatMap((problem) => {
    const range = problem.node === null ? undefined : places.get(problem.node);
    if (!range || range.open_end > length) return [];
    const { message, hint } = textOf(problem);
    return [
      {
        from: range.start,
        to: range.open_end,
        severity: SEVERITY[problem.severity],
        message: [message, hint].filter(Boolean).join('\n'),
      },
    ];
  });
}

/** Returns the findings in the text, as marks on their lines. */
export function findingMarks(doc: Text, findings: readonly Diagnostic[]): Mark[] {
  const placed = findings.map((finding) => ({ ...finding, file: 'text', line: finding.line ?? 1 }));
  return marksFor(doc, 'text', placed, []);
}
