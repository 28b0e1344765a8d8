import {
  byCondition,
  deciding,
  no,
  unknown,
  yes,
  type Parent,
  type ReasonCode,
  type Rule,
  type Verdict,
} from './verdict';

interface Around {
  /** Why the child was ticked. */
  readonly ticks: ReasonCode;
  /** Why it was not, if the decorator itself can decide that; with the results that it has then. */
  readonly own?: { readonly code: ReasonCode; readonly results: readonly string[] };
}

/** The rule of a decorator: it ticks its child whenever it is ticked, except for its own reason. */
function around({ ticks, own }: Around): Rule {
  return (parent) => {
    const { node, result } = parent;
    const [child] = node.children;
    if (!child) return [];
    if (child.isEvident)
      return [yes(child.last, { code: child.before === 'RUNNING' ? 'childAgain' : ticks })];
    if (result === null) return [unknown()];
    if (result !== 'RUNNING')
      return own?.results.includes(result) ? [byEither(parent, own.code)] : byCondition(parent);
    if (!own?.results.includes('RUNNING') || child.before === 'RUNNING')
      return [yes('RUNNING', { code: child.before === 'RUNNING' ? 'childAgain' : ticks })];
    // If the node was halted in the same tick, so was a child that had started.
    return [node.after === 'RUNNING' ? no({ code: own.code, status: result }) : unknown()];
  };
}

/** Returns the verdict if a pre-condition or the decorator itself can have decided. */
function byEither(parent: Parent, code: ReasonCode): Verdict {
  const { conditions } = parent.node;
  if (conditions === null) return no({ code: 'notRecorded' });
  const able = deciding(parent);
  return no(able.length > 0 ? { code: 'notRecorded' } : { code, status: parent.result ?? 'IDLE' });
}

const CHILD: Rule = around({ ticks: 'child' });
const ENDS = ['SUCCESS', 'FAILURE', 'SKIPPED'];
const REFUSED = around({ ticks: 'admitted', own: { code: 'refused', results: [...ENDS, 'RUNNING'] } });
const LOOP = around({ ticks: 'element', own: { code: 'noElement', results: [...ENDS, 'RUNNING'] } });

/** The rules of the decorators, by type. */
export const DECORATOR_RULES: Readonly<Record<string, Rule>> = {
  SubTree: CHILD,
  Inverter: CHILD,
  ForceSuccess: CHILD,
  ForceFailure: CHILD,
  KeepRunningUntilFailure: CHILD,
  Repeat: around({ ticks: 'child', own: { code: 'noCycle', results: ['SUCCESS'] } }),
  RetryUntilSuccessful: around({ ticks: 'child', own: { code: 'noCycle', results: ['FAILURE'] } }),
  RunOnce: around({ ticks: 'child', own: { code: 'ranOnce', results: ENDS } }),
  Timeout: around({ ticks: 'child', own: { code: 'expired', results: ['FAILURE'] } }),
  Delay: around({ ticks: 'delayOver', own: { code: 'delay', results: ['RUNNING'] } }),
  Precondition: REFUSED,
  SkipUnlessUpdated: around({ ticks: 'updated', own: { code: 'notUpdated', results: ['SKIPPED'] } }),
  WaitValueUpdate: around({ ticks: 'updated', own: { code: 'notUpdated', results: ['RUNNING'] } }),
  ...Object.fromEntries(['Int', 'Double', 'String', 'Bool'].map((type) => [`Loop${type}`, LOOP])),
};
