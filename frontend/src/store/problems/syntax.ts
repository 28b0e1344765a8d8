import type { PythonFinding } from '@/api/python';
import type { Diagnostic } from '@/api/types';
import type { CodeFinding } from '@/store/language';
import type { Linted, TextErrors } from './texts';

/** The findings in the text of one file while the user edits it. */
export interface FileFindings {
  readonly served?: readonly CodeFinding[] | undefined;
  readonly linted?: Linted | undefined;
  readonly errors?: TextErrors | undefined;
}

const SYNTAX = 'ty invalid-syntax';

const servesSyntax = ({ served = [] }: FileFindings): boolean =>
  served.some(({ source }) => source === SYNTAX);

/**
 * Returns whether a newer check of the text reports the same error as the check of the last save: the
 * language server and ruff for Python, the editor for JSON.
 */
export function isSuperseded(item: Pick<Diagnostic, 'code'>, found: FileFindings): boolean {
  if (item.code === 'BT0001') return found.errors !== undefined;
  if (item.code !== 'BT0601') return false;
  return servesSyntax(found) || (found.linted?.findings ?? []).some(({ severity }) => severity === 'error');
}

/** Returns ruff's findings, without its syntax errors if the language server reports them. */
export function lintFindings(found: FileFindings): readonly PythonFinding[] {
  const findings = found.linted?.findings ?? [];
  return servesSyntax(found) ? findings.filter(({ severity }) => severity !== 'error') : findings;
}
