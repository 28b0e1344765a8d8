import type { Diagnostic as Mark } from '@codemirror/lint';
import type { Text } from '@codemirror/state';
import type { TestReport } from '@/api/types';
import { t } from '@/i18n';
import { revealFailure } from '@/store/behaviourTests/failures';
import { spanAt } from './diagnostics';

/** Returns the marks of the failures in a file of tests; each leads to its block. */
export function testMarks(doc: Text, path: string, report: TestReport | null): Mark[] {
  if (!report) return [];
  const failed = report.tests
    .filter(({ file }) => file === path)
    .flatMap(({ failures }) => failures)
    .map((failure): Mark => ({
      ...spanAt(doc, failure.line, 0),
      severity: 'error',
      message: failure.node ? `${failure.node}: ${failure.message}` : failure.message,
      ...(failure.node_id === ''
        ? {}
        : { actions: [{ name: t('behaviourTests:mark.show'), apply: () => revealFailure(failure) }] }),
    }));
  const unread = report.problems
    .filter(({ file }) => file === path)
    .map(({ line, column, message, hint, code }): Mark => ({
      ...spanAt(doc, line ?? 1, column ?? 0),
      severity: 'error',
      message: [message, hint].filter(Boolean).join('\n'),
      source: code,
    }));
  return [...failed, ...unread];
}
