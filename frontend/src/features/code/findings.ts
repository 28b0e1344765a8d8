import type { Diagnostic as Mark } from '@codemirror/lint';
import { Text } from '@codemirror/state';
import type { CodeFinding } from '@/store/language';
import { applyFix, offsetOf } from './language/ruff';
import { lintFindings, type FileFindings } from '@/store/problems/syntax';

function offset(doc: Text, { line, character }: CodeFinding['from']): number {
  if (line >= doc.lines) return doc.length;
  const { from, to } = doc.line(line + 1);
  return Math.min(from + character, to);
}

/** Returns the mark of a language server's finding in the current text. */
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

/** Returns whether findings refer to the text in the editor, which counts each line end as one character. */
export function isOf(doc: Text, found: { readonly text: string } | undefined): boolean {
  return found !== undefined && Text.of(found.text.split(/\r\n?|\n/)).eq(doc);
}

/**
 * Returns the marks of ruff's findings, each with a button that fixes it; none while the findings refer to an
 * older text.
 */
export function lintMarks(doc: Text, found: FileFindings): Mark[] {
  if (!isOf(doc, found.linted)) return [];
  return lintFindings(found).map((finding) => {
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
