import type { NodeId } from '../diagram';
import type { ScriptProblem } from '../script';
import kinds from '../kinds.json';

export type Severity = 'error' | 'warning' | 'note';
export type ProblemKind = keyof typeof kinds;

/** The translator's codes (translator/diagnostics.json) of the problems that the page finds too. */
export const CODES: Readonly<Record<ProblemKind, readonly string[]>> = kinds;

/** A problem as data: i18n makes its message from `problems:<kind>` and `values`. */
export interface Problem {
  readonly kind: ProblemKind;
  readonly severity: Severity;
  readonly node: NodeId | null;
  readonly port?: string;
  readonly values: Readonly<Record<string, string | number>>;
  /** The syntax error of an invalid script. */
  readonly script?: ScriptProblem;
}

/** Returns an error at a port of a node. */
export function atPort(
  kind: ProblemKind,
  node: NodeId,
  port: string,
  values: Problem['values'] = {},
  severity: Severity = 'error',
): Problem {
  return { kind, severity, node, port, values: { port, ...values } };
}
