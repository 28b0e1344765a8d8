import type { Force, ForceEffect, TreeNode } from '@/generated/messages';
import { isLookingBack } from '@/store/moment/store';
import { goOn, isStopped } from '@/store/python/stop';
import { hasApplication, isHeld, reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';

const isDriver = () => useSessionStore.getState().introspection?.role === 'driver' && !isLookingBack();

/** Returns whether the user of this page controls the held tree, or the program that is held at a line. */
export const canDebug = (): boolean => (isHeld() || isStopped()) && isDriver();
/**
 * Returns whether the tree is that of this session. Groot2's protocol, by which another program is followed, has no
 * steps, no conditions, and no results but SUCCESS and FAILURE.
 */
export const isOwnTree = ({ attached }: Pick<SessionData, 'attached'>): boolean => attached === null;
/** Returns whether the held tree or program can make a step. */
export const canStep = (): boolean => canDebug() && isOwnTree(useSessionStore.getState());
/** Returns whether the tree is held at a block, and this user can let it make steps. */
export const canStepTree = (): boolean => canStep() && isHeld() && !isStopped();

/** Returns whether the user of this page can force results now. */
export const canForce = (): boolean => hasApplication() && isDriver();

/** Continues the tree, or the program that is stopped at a line of Python. */
export const continueRun = () => (isStopped() ? goOn('continue') : reported(send('continue_run', {})));
export const stepInto = () => (isStopped() ? goOn('stepIn') : reported(send('step_into', {})));
export const stepOver = () => (isStopped() ? goOn('next') : reported(send('step_over', {})));
export const stepOut = () => (isStopped() ? goOn('stepOut') : reported(send('step_out', {})));

/** Lets the held tree continue until a node is to be ticked. */
export const stepTo = ({ uid, path }: TreeNode) => reported(send('step_to', { uid, path }));

/** Lets the held tree continue to the beginning of its next tick. */
export async function stepTick(): Promise<void> {
  const { tree, forced } = useSessionStore.getState();
  const root = tree[(forced?.alone || 1) - 1];
  if (root) await stepTo(root);
}

/** Returns the nodes of the running tree that a block is; several if its tree is called several times. */
export const nodesOf = ({ tree }: { readonly tree: readonly TreeNode[] }, treeId: string, nodeId: string) =>
  tree.filter((node) => node.tree_id === treeId && node.node_id === nodeId);

/** Returns the ids of the SubTree blocks that lead to a node, from the main tree on. */
export function instanceOf(tree: readonly TreeNode[], node: TreeNode): string[] {
  const keys: string[] = [];
  for (let each = tree[node.parent - 1]; each; each = tree[each.parent - 1]) {
    if (each.type === 'SubTree') keys.unshift(each.node_id);
  }
  return keys;
}

type Held = Pick<SessionData, 'tree' | 'held'>;

/** Returns the one node that a block is: on the path of the hold if one is there, else the first. */
export function nodeOf(session: Held, treeId: string, nodeId: string): TreeNode | undefined {
  const found = nodesOf(session, treeId, nodeId);
  if (found.length < 2 || !session.held) return found[0];
  // The innermost tree that the hold is in and that has the block.
  for (const uid of [...session.held.path].reverse()) {
    const around = session.tree[uid - 1];
    if (!around) continue;
    const keys = JSON.stringify(instanceOf(session.tree, around));
    const near = found.find((node) => JSON.stringify(instanceOf(session.tree, node)) === keys);
    if (near) return near;
  }
  return found[0];
}

/** Sequences and fallbacks pass over a skipped child; also by the names that the engine takes for them. */
const PASSING = new Set([
  ...['Sequence', 'AsyncSequence', 'SequenceWithMemory', 'ReactiveSequence', 'SequenceStar'],
  ...['Fallback', 'AsyncFallback', 'ReactiveFallback', 'FallbackStar'],
  ...['SequentialStar', 'Selector', 'ReactiveSelector'],
]);

/** Returns the type of the node's parent if siblings before the node cannot be skipped below it; else null. */
export function blocksSkip(tree: readonly TreeNode[], { parent }: TreeNode): string | null {
  const type = tree[parent - 1]?.type;
  return type === undefined || PASSING.has(type) ? null : type;
}

type Forcing = { readonly effect: ForceEffect } & Partial<Pick<Force, 'status' | 'once' | 'after'>>;

/** Forces a result on nodes of the running tree. */
export async function force(nodes: readonly TreeNode[], forcing: Forcing): Promise<void> {
  const { effect, status = 'SUCCESS', once = false, after = false } = forcing;
  for (const { uid, path } of nodes)
    await reported(send('force', { uid, path, effect, status, once, after }));
}

/** Ends what is forced on nodes; on all nodes without an argument. */
export async function release(uids?: readonly number[]): Promise<void> {
  for (const uid of uids ?? [null]) await reported(send('release', { uid }));
}
