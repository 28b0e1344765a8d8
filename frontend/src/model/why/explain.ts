import type { NodeStatus } from '@/generated/messages';
import { CONTROL_RULES } from './controls';
import { DECORATOR_RULES } from './decorators';
import { isOnHalt, readFacts, type NodeFacts, type TickFacts } from './facts';
import { no, unknown, yes, type Reason, type Rule, type Verdict } from './verdict';

/** The rules by type; all other nodes with children are decided by their own Python. */
export const RULES: Readonly<Record<string, Rule>> = { ...CONTROL_RULES, ...DECORATOR_RULES };

/** A node on the path from the root, and why its parent ticked it or did not. */
export interface Step {
  readonly uid: number;
  readonly parent: number;
  readonly verdict: Verdict;
}

export interface Explanation {
  /** From the root to the node; it ends early at a node that was not ticked. */
  readonly steps: readonly Step[];
  /** Why the node has its result; null for a leaf, and for a node that was not ticked. */
  readonly outcome: Reason | null;
}

const ROOT: Reason = { code: 'root' };

/**
 * How complete the recording is below a node: all results; only results that no later tick replaced; or no order
 * of results, since the node was ticked several times.
 */
type Trust = 'all' | 'traces' | 'none';

/** Returns the verdicts for the children of a node. */
function judge(node: NodeFacts, { ticked, result }: Verdict, trust: Trust): readonly Verdict[] {
  const { children } = node;
  if (node.isForced && ticked !== 'no') return children.map((child) => belowForced(node, child));
  if (ticked === 'unknown') return children.map(() => unknown());
  if (ticked === 'no') return children.map((child) => whileHalted(node, child));
  const rule = RULES[node.type];
  const code = rule ? 'several' : 'own';
  if (!rule || trust === 'none')
    return children.map((child) => (child.isEvident ? yes(child.last, { code }) : unknown(code)));
  const judged = rule({ node, result });
  if (trust === 'all') return judged;
  return judged.map((each, at) => (children[at]?.isEvident ? each : unknown()));
}

/** Returns the verdict for a child of a node whose result was forced, in place of its tick or after it. */
function belowForced({ last }: NodeFacts, child: NodeFacts): Verdict {
  if (child.isEvident) return yes(child.last, { code: 'notRecorded' });
  return no({ code: 'parentForced', ...(last === null ? {} : { status: last }) });
}

/** Returns the verdict for a child of a node that was not ticked; a halt can tick the last child of TryCatch. */
function whileHalted(node: NodeFacts, child: NodeFacts): Verdict {
  if (child.isEvident) return yes(child.last, { code: 'own' });
  const isUnsure = isOnHalt(node) && child === node.children.at(-1);
  return isUnsure ? unknown() : no({ code: 'parentNot' });
}

function trustBelow(node: NodeFacts, { reason, ticked }: Verdict, above: Trust): Trust {
  if (above === 'none' || node.isRepeated) return 'none';
  if (above === 'traces') return above;
  const mayFollow = node.after === 'IDLE' || (node.after === 'RUNNING' && node.last === 'SKIPPED');
  return ticked === 'yes' && reason.code === 'own' && mayFollow ? 'traces' : 'all';
}

function verdictOfRoot(root: NodeFacts): Verdict {
  const { isEvident, last, after } = root;
  return yes(isEvident ? last : after === 'IDLE' ? null : after, ROOT);
}

/**
 * Returns why a node was ticked in a tick, or was not, from recorded results alone; null if the tree has no such
 * node.
 */
export function explain(facts: TickFacts, uid: number): Explanation | null {
  const all = readFacts(facts);
  const path: NodeFacts[] = [];
  for (let node = all.get(uid); node; node = all.get(node.parent)) path.unshift(node);
  const [root] = path;
  if (!root) return null;
  let verdict = verdictOfRoot(root);
  let trust = trustBelow(root, verdict, 'all');
  const steps: Step[] = [{ uid: root.uid, parent: 0, verdict }];
  for (const [at, node] of path.entries()) {
    const next = path[at + 1];
    if (!next) return { steps, outcome: outcomeOf(node, verdict, trust) };
    const found = judge(node, verdict, trust)[node.children.indexOf(next)];
    if (!found) return null;
    verdict = found;
    trust = trustBelow(next, verdict, trust);
    steps.push({ uid: next.uid, parent: node.uid, verdict });
    if (verdict.ticked !== 'yes') break;
  }
  return { steps, outcome: null };
}

/** Returns the verdict for each node of the tree. */
export function verdicts(facts: TickFacts): Map<number, Verdict> {
  const all = readFacts(facts);
  const found = new Map<number, Verdict>();
  const visit = (node: NodeFacts, verdict: Verdict, above: Trust): void => {
    found.set(node.uid, verdict);
    const trust = trustBelow(node, verdict, above);
    const judged = judge(node, verdict, trust);
    node.children.forEach((child, at) => visit(child, judged[at] ?? unknown(), trust));
  };
  const root = facts.nodes[0] && all.get(facts.nodes[0].uid);
  if (root) visit(root, verdictOfRoot(root), 'all');
  return found;
}

function outcomeOf(node: NodeFacts, verdict: Verdict, trust: Trust): Reason | null {
  if (verdict.ticked !== 'yes') return null;
  if (node.isForced)
    return { code: 'forced', ...(verdict.result === null ? {} : { status: verdict.result }) };
  if (node.children.length === 0) return null;
  const judged = judge(node, verdict, trust);
  const ticked = judged.flatMap((each, at) => {
    const child = node.children[at];
    return each.ticked === 'yes' && child ? [{ child, result: each.result }] : [];
  });
  const wanted: NodeStatus | null = verdict.result === 'RUNNING' ? 'RUNNING' : null;
  const decider = ticked.findLast(({ result }) => wanted === null || result === wanted) ?? ticked.at(-1);
  if (decider?.result) return { code: 'after', by: decider.child.uid, status: decider.result };
  return judged[0]?.reason ?? null;
}
