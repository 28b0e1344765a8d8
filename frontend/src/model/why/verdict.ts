import type { NodeStatus } from '@/generated/messages';
import type { NodeFacts } from './facts';

/** Why a node was ticked or not, or has its result. Texts: `why.reason.<code>`. */
export const REASONS = [
  // It was ticked.
  'root',
  'first',
  'each',
  'after',
  'afterEarlier',
  'goesOn',
  'resumed',
  'all',
  'chosen',
  'chosenEarlier',
  'case',
  'otherwise',
  'caught',
  'catching',
  'child',
  'childAgain',
  'delayOver',
  'admitted',
  'updated',
  'element',
  // It was not.
  'parentNot',
  'ended',
  'waits',
  'yielded',
  'done',
  'passed',
  'decided',
  'conditionRuns',
  'notChosen',
  'notChosenEarlier',
  'otherCase',
  'noFailure',
  'condition',
  'delay',
  'expired',
  'refused',
  'ranOnce',
  'notUpdated',
  'noCycle',
  'noElement',
  'parentForced',
  // Either.
  'forced',
  'own',
  'several',
  'notRecorded',
] as const;
export type ReasonCode = (typeof REASONS)[number];

export interface Reason {
  readonly code: ReasonCode;
  /** The sibling or child on which the decision depends. */
  readonly by?: number;
  /** The result of `by`, or the result that was decided. */
  readonly status?: NodeStatus;
  /** The pre-conditions that can have decided; empty if they are not known. */
  readonly conditions?: readonly string[];
}

/**
 * Whether a node was ticked, its result (null if that was not recorded), and the reason. The result is the last
 * one, except below own controls and nodes that were ticked several times, where a later RUNNING leaves no trace.
 */
export interface Verdict {
  readonly ticked: 'yes' | 'no' | 'unknown';
  readonly result: NodeStatus | null;
  readonly reason: Reason;
}

export const yes = (result: NodeStatus | null, reason: Reason): Verdict => ({
  ticked: 'yes',
  result,
  reason,
});
export const no = (reason: Reason): Verdict => ({ ticked: 'no', result: null, reason });
export const unknown = (code: 'own' | 'several' | 'notRecorded' = 'notRecorded'): Verdict => ({
  ticked: 'unknown',
  result: null,
  reason: { code },
});

/** A node that was ticked, with its last result. */
export interface Parent {
  readonly node: NodeFacts;
  readonly result: NodeStatus | null;
}

/** Returns a verdict for each child of a node that was ticked, in order. */
export type Rule = (parent: Parent) => readonly Verdict[];

const OF_RESULT: Partial<Record<NodeStatus, readonly string[]>> = {
  FAILURE: ['_failureIf'],
  SUCCESS: ['_successIf'],
  SKIPPED: ['_skipIf', '_while'],
};

/** Returns the pre-conditions that can have given a node its result. */
export function deciding({ node, result }: Parent): readonly string[] {
  // A RUNNING node is tested by `_while` alone.
  const known = node.before === 'RUNNING' && result === 'SKIPPED' ? ['_while'] : OF_RESULT[result ?? 'IDLE'];
  return (known ?? []).filter((name) => node.conditions?.includes(name) ?? true);
}

/** Returns the verdicts for the children of a node that a pre-condition decided. */
export function byCondition(parent: Parent): readonly Verdict[] {
  const conditions = parent.node.conditions === null ? [] : deciding(parent);
  const reason = { code: 'condition', status: parent.result ?? 'SKIPPED', conditions } as const;
  return parent.node.children.map(() => no(reason));
}
