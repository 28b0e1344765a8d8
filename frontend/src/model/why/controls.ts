import type { NodeStatus } from '@/generated/messages';
import { isDone, type NodeFacts } from './facts';
import { byCondition, no, unknown, yes, type Parent, type Reason, type Rule, type Verdict } from './verdict';

const lastIndex = (children: readonly NodeFacts[], has: (child: NodeFacts) => boolean): number =>
  children.findLastIndex(has);
const evident = ({ isEvident }: NodeFacts) => isEvident;
const wasRunning = ({ before }: NodeFacts) => before === 'RUNNING';
const by = (code: Reason['code'], { uid }: NodeFacts, status: NodeStatus): Reason => ({
  code,
  by: uid,
  status,
});

interface Order {
  readonly goesOn: NodeStatus;
  readonly ends: NodeStatus;
  /** Whether it is RUNNING after each child that was done within the tick. */
  readonly yields?: boolean;
  /** Whether it starts again at the child that failed. */
  readonly remembers?: boolean;
  /** Whether it begins with the first child at every tick. */
  readonly isReactive?: boolean;
}

const SEQUENCE = { goesOn: 'SUCCESS', ends: 'FAILURE' } as const;
const FALLBACK = { goesOn: 'FAILURE', ends: 'SUCCESS' } as const;

/** Returns the child that returned RUNNING; -1 if none did, null if that was not recorded. */
function runningChild({ node, result }: Parent, order: Order): number | null {
  const { children, before } = node;
  if (result === null) return null;
  if (result !== 'RUNNING') return -1;
  const reached = lastIndex(children, evident);
  if (reached < 0) {
    if (order.isReactive === true) return 0;
    if (before === 'RUNNING') {
      const resumed = lastIndex(children, wasRunning);
      return resumed < 0 ? null : resumed;
    }
    return order.remembers === true ? null : 0;
  }
  const last = children[reached];
  if (last?.last === 'RUNNING') return reached;
  if (last?.last === order.goesOn || last?.last === 'SKIPPED') {
    if (reached + 1 >= children.length) return null;
    const isQuick = order.yields === true && last.last === order.goesOn && last.before === 'IDLE';
    return isQuick ? -1 : reached + 1;
  }
  return null;
}

/** The rule of sequences and fallbacks. */
function ordered(order: Order): Rule {
  return (parent) => {
    const { node, result } = parent;
    const { children } = node;
    const running = runningChild(parent, order);
    if (running === -1 && result !== 'RUNNING' && !children.some(evident)) return byCondition(parent);
    const wasTicked = (at: number) => children[at]?.isEvident === true || at === running;
    const first = children.findIndex((_, at) => wasTicked(at));
    const last = children.findLastIndex((_, at) => wasTicked(at));
    return children.map((child, at): Verdict => {
      if (child.isEvident) return yes(child.last, whyTicked(parent, order, at, first));
      if (at === running) return yes('RUNNING', whyTicked(parent, order, at, first));
      if (running === null) return unknown();
      return at > last ? no(whyNotReached(children, last, running, order)) : no(whyPassed(child));
    });
  };
}

function whyTicked({ node }: Parent, order: Order, at: number, first: number): Reason {
  const { children } = node;
  const child = children[at];
  const previous = children[at - 1];
  if (order.isReactive !== true && child?.before === 'RUNNING' && at === first) return { code: 'resumed' };
  if (!previous) return { code: order.isReactive === true ? 'each' : 'first' };
  if (previous.isEvident) return previous.last ? by('after', previous, previous.last) : { code: 'several' };
  return previous.before === order.goesOn
    ? by('afterEarlier', previous, previous.before)
    : { code: 'goesOn' };
}

function whyNotReached(children: readonly NodeFacts[], last: number, running: number, order: Order): Reason {
  const child = children[last];
  if (!child) return { code: 'notRecorded' };
  if (running >= 0) return by('waits', child, 'RUNNING');
  return child.last === order.ends ? by('ended', child, order.ends) : by('yielded', child, order.goesOn);
}

const whyPassed = (child: NodeFacts): Reason =>
  isDone(child.before) ? by('done', child, child.before) : { code: 'passed' };

/** Ticks all children that are not done; `decides` if it can end before the last one. */
function parallel(decides: boolean): Rule {
  return (parent) => {
    const { node, result } = parent;
    const { children } = node;
    const reached = lastIndex(children, evident);
    const isOver = result !== null && result !== 'RUNNING';
    if (isOver && reached < 0 && (!decides || result === 'SKIPPED')) return byCondition(parent);
    return children.map((child, at): Verdict => {
      if (child.isEvident) return yes(child.last, { code: 'all' });
      if (result === null) return unknown();
      if (isDone(child.before)) return no(by('done', child, child.before));
      if (!isOver || !decides || at < reached) return yes('RUNNING', { code: 'all' });
      const decider = children[Math.max(reached, 0)];
      // With a threshold of 0, the first child decides whatever it returns; so can a pre-condition.
      if (reached < 0 && at === 0) return unknown();
      return decider?.last ? no(by('decided', decider, decider.last)) : no({ code: 'decided' });
    });
  };
}

const ifThenElse: Rule = (parent) => {
  const { node, result } = parent;
  const { children } = node;
  const [condition] = children;
  if (!condition || result === null) return children.map(notKnown);
  const isOver = result !== 'RUNNING';
  if (isOver && !children.some(evident)) {
    // Without a third child, a condition that fails again keeps its FAILURE.
    if (result !== 'FAILURE' || condition.after !== 'FAILURE') return byCondition(parent);
    if (node.conditions?.includes('_failureIf') !== false) return children.map(() => unknown());
  }
  const holds = node.before === 'RUNNING' && !condition.isEvident && isDone(condition.before);
  const now = condition.isEvident ? condition.last : isOver ? condition.after : 'RUNNING';
  return branches(children, holds ? condition.before : now, holds);
};

const whileDoElse: Rule = (parent) => {
  const { node, result } = parent;
  const { children } = node;
  const [condition] = children;
  if (!condition || result === null) return children.map(notKnown);
  if (result !== 'RUNNING' && !children.some(evident)) return byCondition(parent);
  // An action that is done returns its result again without being ticked, also if it is reset then.
  const keeps = isDone(condition.before) && (condition.after !== 'IDLE' || condition.children.length === 0);
  const kept = keeps ? condition.before : 'RUNNING';
  return branches(children, condition.isEvident ? condition.last : kept, false);
};

/** Returns the verdicts for a condition and the branches between which it chooses. */
function branches(
  children: readonly NodeFacts[],
  result: NodeStatus | null,
  isEarlier: boolean,
): readonly Verdict[] {
  const [condition] = children;
  const chosen = result === 'SUCCESS' ? 1 : result === 'FAILURE' ? 2 : -1;
  return children.map((child, at): Verdict => {
    if (at === 0) return isEarlier ? no(by('done', child, child.before)) : yes(result, { code: 'each' });
    if (!condition || result === null)
      return child.isEvident ? yes(child.last, { code: 'several' }) : unknown();
    if (child.isEvident || at === chosen) {
      const reason = by(isEarlier ? 'chosenEarlier' : 'chosen', condition, result);
      return yes(child.isEvident ? child.last : 'RUNNING', at === chosen ? reason : { code: 'several' });
    }
    const code = result === 'RUNNING' ? 'conditionRuns' : isEarlier ? 'notChosenEarlier' : 'notChosen';
    return no(by(code, condition, result));
  });
}

const switchCase: Rule = (parent) => {
  const { node, result } = parent;
  const { children } = node;
  if (result !== 'RUNNING' && result !== null && !children.some(evident)) return byCondition(parent);
  const ticked = children.filter(evident);
  const running = children.filter(wasRunning);
  const chosen = ticked.length > 0 ? ticked : running.length === 1 && result === 'RUNNING' ? running : [];
  return children.map((child, at): Verdict => {
    const code = ticked.length > 1 ? 'several' : at === children.length - 1 ? 'otherwise' : 'case';
    if (child.isEvident) return yes(child.last, { code });
    if (chosen.includes(child)) return yes('RUNNING', { code });
    const [other] = chosen;
    return other ? no({ code: 'otherCase', by: other.uid }) : unknown();
  });
};

const tryCatch: Rule = (parent) => {
  const { node, result } = parent;
  const { children } = node;
  const handler = children.at(-1);
  const tried = children.slice(0, -1);
  if (!handler) return [];
  if (result !== null && result !== 'RUNNING' && !children.some(evident)) return byCondition(parent);
  // A halt of the node can tick its last child: also in the tick in which it returned RUNNING or SKIPPED.
  const isHalted = !isDone(result) && node.after !== 'RUNNING';
  const failed = tried.findLast(({ isEvident, last }) => isEvident && last === 'FAILURE');
  const wasCatching = !failed && node.before === 'RUNNING' && handler.before === 'RUNNING';
  const isCatching = failed !== undefined || wasCatching || (handler.isEvident && !isHalted);
  const inner: Parent = { node: { ...node, children: tried }, result: failed ? 'FAILURE' : result };
  const first = isCatching && !failed ? tried.map(alreadyTried) : ordered(SEQUENCE)(inner);
  return [...first, handled(parent, handler, failed, isCatching, isHalted)];
};

function handled(
  { result }: Parent,
  handler: NodeFacts,
  failed: NodeFacts | undefined,
  isCatching: boolean,
  isHalted: boolean,
): Verdict {
  const reason: Reason = failed ? by('caught', failed, 'FAILURE') : { code: 'catching' };
  if (handler.isEvident) return yes(handler.last, isCatching ? reason : { code: 'notRecorded' });
  if (isCatching && result === 'RUNNING') return yes('RUNNING', reason);
  return result === null || isHalted || isCatching ? unknown() : no({ code: 'noFailure' });
}

const alreadyTried = (child: NodeFacts): Verdict =>
  child.isEvident ? yes(child.last, { code: 'goesOn' }) : no({ code: 'passed' });

const notKnown = (child: NodeFacts): Verdict =>
  child.isEvident ? yes(child.last, { code: 'notRecorded' }) : unknown();

/** The rules of the controls with children, by type. */
export const CONTROL_RULES: Readonly<Record<string, Rule>> = {
  Sequence: ordered(SEQUENCE),
  AsyncSequence: ordered({ ...SEQUENCE, yields: true }),
  SequenceWithMemory: ordered({ ...SEQUENCE, yields: true, remembers: true }),
  ReactiveSequence: ordered({ ...SEQUENCE, isReactive: true }),
  Fallback: ordered(FALLBACK),
  AsyncFallback: ordered({ ...FALLBACK, yields: true }),
  ReactiveFallback: ordered({ ...FALLBACK, isReactive: true }),
  Parallel: parallel(true),
  ParallelAll: parallel(false),
  IfThenElse: ifThenElse,
  WhileDoElse: whileDoElse,
  ...Object.fromEntries([2, 3, 4, 5, 6].map((cases) => [`Switch${cases}`, switchCase])),
  TryCatch: tryCatch,
};
