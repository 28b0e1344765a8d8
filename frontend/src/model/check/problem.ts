import type { NodeId } from '../diagram';
import type { ScriptProblem } from '../script';
import kinds from '../kinds.json';

export type Severity = 'error' | 'warning' | 'note';
export type ProblemKind = keyof typeof kinds;

/** The translator's codes (translator/diagnostics.json) of what is found here too. */
export const CODES: Readonly<Record<ProblemKind, readonly string[]>> = kinds;

/** What is wrong, as data: the words are made by i18n (`problems:<kind>`) from `values`. */
export interface Problem {
  readonly kind: ProblemKind;
  readonly severity: Severity;
  readonly node: NodeId | null;
  readonly port?: string;
  readonly values: Readonly<Record<string, string | number>>;
  /** Of a script that cannot be read: why. */
  readonly script?: ScriptProblem;
}

/** An error at a port of a node. */
export function atPort(
  kind: ProblemKind,
  node: NodeId,
  port: string,
  values: Problem['values'] = {},
  severity: Severity = 'error',
): Problem {
  return { kind, severity, node, port, values: { port, ...values } };
}
