import type { Diagnostic as Mark } from '@codemirror/lint';
import type { Text } from '@codemirror/state';
import type { Diagnostic } from '@/api/types';
import type { Fault } from '@/generated/messages';
import { findingText } from '@/ui/findingText';

const SEVERITY = { error: 'error', warning: 'warning', note: 'info' } as const;

/**
 * Returns the range of the word at a position, or of the rest of the line; column 0 means the first character
 * that is not blank.
 */
export function spanAt(doc: Text, line: number, column: number): { from: number; to: number } {
  const { from, to, text } = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const indent = text.length - text.trimStart().length;
  const start = from + (column > 0 ? Math.min(column - 1, text.length) : indent);
  const word = /^[\w.]+/.exec(text.slice(start - from))?.[0].length ?? 0;
  const end = column > 0 && word > 0 ? start + word : to;
  return { from: Math.min(start, end), to: end };
}

/** Returns the marks in one file: findings of the checks, and exceptions of the run. */
export function marksFor(
  doc: Text,
  path: string,
  diagnostics: readonly Diagnostic[],
  faults: readonly Fault[],
): Mark[] {
  const found = diagnostics
    .filter((item) => item.file === path && item.line)
    .map((item): Mark => {
      const { message, hint } = findingText(item);
      return {
        ...spanAt(doc, item.line ?? 1, item.column ?? 0),
        severity: SEVERITY[item.severity],
        message: [message, hint].filter(Boolean).join('\n'),
        source: item.code,
      };
    });
  const raised = faults
    .filter((fault) => fault.file === path && fault.line > 0)
    .map((fault): Mark => ({
      ...spanAt(doc, fault.line, 0),
      severity: 'error',
      message: [fault.message, fault.hint].filter(Boolean).join('\n'),
      markClass: 'cm-faultLine',
    }));
  return [...found, ...raised];
}
