import type { NodeStatus } from '@/generated/messages';
import { busiest, liveKey, type LiveKey } from '@/store/project/live';
import type { RecordedNode, StatusOf } from '@/store/recording/types';

/** The tree of one of two runs, and what its nodes did in the last tick. */
export interface Side {
  readonly nodes: readonly RecordedNode[];
  readonly statuses: readonly StatusOf[];
  readonly flashes: readonly StatusOf[];
}

/** The status of a node; null if the tree of this run has no such node. */
export type StatusThere = NodeStatus | null;

/** A node whose status differs between two runs. */
export interface Difference {
  readonly id: string;
  readonly tree: string;
  readonly node: string;
  readonly path: string;
  readonly here: StatusThere;
  readonly there: StatusThere;
}

interface Found {
  readonly node: RecordedNode;
  readonly status: NodeStatus;
}

/**
 * Returns the nodes of a tree by what identifies them in other trees, too: the numbers and paths of nodes change
 * with each block that is added, but not the ids of diagrams, their blocks and the SubTrees that called them.
 */
function identifiedIn({ nodes, statuses, flashes }: Side): Map<string, Found> {
  const now = new Map(statuses);
  const passed = new Map(flashes);
  const calls = new Map<number, { readonly tree: string; readonly call: string; readonly id: string }>();
  const found = new Map<string, Found>();
  for (const node of nodes) {
    const parent = calls.get(node.parent);
    const call = parent === undefined ? '' : parent.tree === node.tree_id ? parent.call : parent.id;
    const id = `${call} ${liveKey(node.tree_id, node.node_id)}`;
    calls.set(node.uid, { tree: node.tree_id, call, id });
    // A result that did not stay says more than the IDLE after it.
    const status = now.get(node.uid) ?? passed.get(node.uid) ?? 'IDLE';
    if (node.node_id !== '') found.set(id, { node, status });
  }
  return found;
}

/** Returns the nodes whose statuses differ, in the order of the tree. */
export function differences(here: Side, there: Side): Difference[] {
  const [own, other] = [identifiedIn(here), identifiedIn(there)];
  return [...new Map([...own, ...other]).keys()].flatMap((id): Difference[] => {
    const [a, b] = [own.get(id), other.get(id)];
    const node = (a ?? b)?.node;
    if (!node || a?.status === b?.status) return [];
    const { tree_id: tree, node_id, path } = node;
    return [{ id, tree, node: node_id, path, here: a?.status ?? null, there: b?.status ?? null }];
  });
}

/**
 * Returns the blocks of the first tree whose statuses differ, with their status in the second. A block of a tree
 * that is called twice has the status of its most active node, as on the canvas.
 */
export function differingBlocks(here: Side, there: Side): Map<LiveKey, StatusThere> {
  const [own, other] = [byBlock(here), byBlock(there)];
  const found = new Map<LiveKey, StatusThere>();
  for (const [key, status] of own) {
    const then = other.get(key) ?? null;
    if (then !== status) found.set(key, then);
  }
  return found;
}

function byBlock(side: Side): Map<LiveKey, NodeStatus> {
  const blocks = new Map<LiveKey, NodeStatus>();
  for (const { node, status } of identifiedIn(side).values()) {
    const key = liveKey(node.tree_id, node.node_id);
    blocks.set(key, busiest([blocks.get(key) ?? 'IDLE', status]));
  }
  return blocks;
}
