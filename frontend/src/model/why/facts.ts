import type { NodeStatus, TreeNode } from '@/generated/messages';

type Pair = readonly [uid: number, status: NodeStatus];

/** The recorded data of one tick. */
export interface TickFacts {
  /** The nodes in pre-order. */
  readonly nodes: readonly Pick<TreeNode, 'uid' | 'parent' | 'type' | 'kind'>[];
  /** The statuses before the tick; a node that is missing was IDLE. */
  readonly before: ReadonlyMap<number, NodeStatus>;
  /** The nodes whose status differs after the tick, with the new status. */
  readonly changed: readonly Pair[];
  /** Results within the tick that did not stay, in order. */
  readonly flashed: readonly Pair[];
  /** The nodes whose result was forced by the debugger. */
  readonly forced?: ReadonlySet<number>;
  /** The names of the pre-conditions of a node; null if they are not known. */
  readonly conditions: (uid: number) => readonly string[] | null;
}

/** A node in one tick, as far as its own statuses tell. */
export interface NodeFacts {
  readonly uid: number;
  readonly type: string;
  readonly kind: string;
  readonly parent: number;
  readonly children: readonly NodeFacts[];
  readonly before: NodeStatus;
  readonly after: NodeStatus;
  /** Whether the node, or one below it, returned something that was recorded: then it was ticked. */
  readonly isEvident: boolean;
  /** Its last result, if `isEvident`; null if the order of several results was not recorded. */
  readonly last: NodeStatus | null;
  /** Whether the node was certainly ticked more than once in the tick. */
  readonly isRepeated: boolean;
  /** Whether its result was forced by the debugger. */
  readonly isForced: boolean;
  readonly conditions: readonly string[] | null;
}

type Growing = { -readonly [K in keyof NodeFacts]: NodeFacts[K] } & { children: Growing[] };

export const isDone = (status: NodeStatus | null): boolean => status === 'SUCCESS' || status === 'FAILURE';

/** Returns all nodes by uid. */
export function readFacts({
  nodes,
  before,
  changed,
  flashed,
  forced,
  conditions,
}: TickFacts): Map<number, NodeFacts> {
  const newly = new Map(changed);
  const results = new Map<number, NodeStatus[]>();
  for (const [uid, status] of flashed) {
    const list = results.get(uid);
    if (list) list.push(status);
    else results.set(uid, [status]);
  }
  const all = new Map<number, Growing>();
  for (const { uid, parent, type, kind } of nodes) {
    const was = before.get(uid) ?? 'IDLE';
    const after = newly.get(uid) ?? was;
    const own = ownResult(was, newly.get(uid) ?? null, results.get(uid) ?? []);
    const isForced = forced?.has(uid) ?? false;
    const node: Growing = {
      ...{ uid, parent, type, kind, children: [], before: was, after, ...own, isForced },
      // A frozen node is RUNNING from one tick to the next, and nothing changes.
      ...(isForced && !own.isEvident ? { isEvident: true, last: after } : {}),
      conditions: conditions(uid),
    };
    all.set(uid, node);
    all.get(parent)?.children.push(node);
  }
  // Children come after their parents: from the last node on, each is complete when its parent is reached.
  for (const { uid } of nodes.toReversed()) takeChildren(all.get(uid));
  return all;
}

function ownResult(
  before: NodeStatus,
  changedTo: NodeStatus | null,
  flashes: readonly NodeStatus[],
): Pick<NodeFacts, 'isEvident' | 'last' | 'isRepeated'> {
  const after = changedTo ?? before;
  const isNew = changedTo !== null && changedTo !== 'IDLE';
  const flash = flashes.at(-1) ?? null;
  const isRestarted = after === 'RUNNING' && flashes.some(isDone);
  const isRepeated = flashes.length > 1 || isRestarted || (flash !== null && isNew && isDone(after));
  return { isEvident: isNew || flash !== null, last: lastOf(after, isNew, flash), isRepeated };
}

function lastOf(after: NodeStatus, isNew: boolean, flash: NodeStatus | null): NodeStatus | null {
  if (flash === null) return isNew ? after : null;
  if (after === 'IDLE') return flash;
  // A node that starts and is then SKIPPED keeps the status RUNNING.
  if (after === 'RUNNING') return flash === 'SKIPPED' ? flash : after;
  return isNew || flash !== 'SKIPPED' ? null : flash;
}

/** A node was ticked if one below it was. */
function takeChildren(node: Growing | undefined): void {
  if (!node || node.isEvident || !node.children.some((child) => child.isEvident && !isOnHalt(node))) return;
  node.isEvident = true;
  node.last = node.after === 'IDLE' ? 'RUNNING' : node.after;
}

/** Returns whether the node was halted: TryCatch can tick its last child then, without being ticked. */
export function isOnHalt({ type, before, after }: NodeFacts): boolean {
  return type === 'TryCatch' && before === 'RUNNING' && after !== 'RUNNING';
}
