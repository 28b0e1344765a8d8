import type { Diagnostic as Mark } from '@codemirror/lint';
import type { Text } from '@codemirror/state';
import type { Diagnostic } from '@/api/types';
import type { CodeFinding } from '@/store/language';
import { applyFix, offsetOf } from './language/ruff';
import type { Linted } from './useFindings';

function offset(doc: Text, { line, character }: CodeFinding['from']): number {
  if (line >= doc.lines) return doc.length;
  const { from, to } = doc.line(line + 1);
  return Math.min(from + character, to);
}

/** A finding of the language server, mapped to the present text. */
export function servedMark(doc: Text, finding: CodeFinding): Mark {
  const from = offset(doc, finding.from);
  return {
    from,
    to: Math.max(from, offset(doc, finding.to)),
    severity: finding.severity,
    message: finding.message,
    source: finding.source,
  };
}

/**
 * Whether another checker reports the finding: the editor checks JSON while the user types, the language
 * server Python.
 */
export const isToldBetter = (item: Diagnostic, isServed: boolean): boolean =>
  item.code === 'BT0001' || (isServed && item.code === 'BT0601');

/** Findings of ruff, each with a button that fixes it; none while they refer to an older text. */
export function lintMarks(doc: Text, linted: Linted | null, isServed: boolean): Mark[] {
  if (!linted?.doc.eq(doc)) return [];
  return linted.findings
    .filter((finding) => !(isServed && finding.severity === 'error'))
    .map((finding) => {
      const from = offsetOf(doc, finding.start);
      return {
        from,
        to: Math.max(from, offsetOf(doc, finding.end)),
        severity: finding.severity,
        message: finding.message,
        source: `ruff ${finding.code}`,
        ...(finding.fix
          ? {
              actions: [
                {
                  name: finding.fix.message,
                  apply: (view) => {
                    applyFix(view, doc, finding);
                  },
                },
              ],
            }
          : {}),
      } satisfies Mark;
    });
}
