import { create } from 'zustand';
import type { Forced, Held, NodeStatus, ResultName, TreeNode } from '@/generated/messages';
import { isLookingBack, useMoment } from '@/store/moment/store';
import { liveKey, type LiveKey } from '@/store/project/live';
import { useSessionStore } from '@/store/session/store';

/** The part of a hold that a block has: the tree is held there, the path leads through it, or it may follow. */
export type HeldMark = 'here' | 'path' | 'ahead';

/** What is forced on a block. */
export interface ForcedMark {
  readonly status: ResultName;
  readonly once: boolean;
  readonly after: boolean;
  /** Whether it is ticked in place of the root; then nothing else holds. */
  readonly alone: boolean;
}

interface DebugMarks {
  readonly held: ReadonlyMap<LiveKey, HeldMark>;
  readonly forced: ReadonlyMap<LiveKey, ForcedMark>;
}

const NO_HOLD: DebugMarks['held'] = new Map();
const NOTHING: DebugMarks['forced'] = new Map();

/** The marks of the debugger on the blocks. In the past the tree is held nowhere; what was forced is marked. */
export const useDebugMarks = create<DebugMarks>(() => ({ held: NO_HOLD, forced: NOTHING }));

/** Keeps the marks as the session tells them. */
export function followMarks(): () => void {
  const show = () => {
    const { tree, held, heldInPython, forced } = useSessionStore.getState();
    const hold = held ?? (heldInPython && { ...heldInPython, ahead: [] });
    const isBack = isLookingBack();
    useDebugMarks.setState({
      held: hold && !isBack ? heldMarks(tree, hold) : NO_HOLD,
      forced: isBack ? pastMarks() : forced ? forcedMarks(tree, forced) : NOTHING,
    });
  };
  show();
  const stops = [
    useSessionStore.subscribe((now, before) => {
      const has = ({ held, heldInPython, forced, tree }: typeof now) => [held, heldInPython, forced, tree];
      if (has(now).some((each, at) => each !== has(before)[at])) show();
    }),
    useMoment.subscribe((now, before) => {
      if (now.shown !== before.shown || (now.t === null) !== (before.t === null)) show();
    }),
  ];
  return () => {
    stops.forEach((stop) => stop());
    useDebugMarks.setState({ held: NO_HOLD, forced: NOTHING });
  };
}

function heldMarks(
  tree: readonly TreeNode[],
  held: Pick<Held, 'uid' | 'path' | 'ahead'>,
): DebugMarks['held'] {
  const marks = new Map<LiveKey, HeldMark>();
  const put = (uids: readonly number[], mark: HeldMark) =>
    uids.forEach((uid) => {
      const node = tree[uid - 1];
      if (node) marks.set(liveKey(node.tree_id, node.node_id), mark);
    });
  put(held.ahead, 'ahead');
  put(held.path, 'path');
  put([held.uid], 'here');
  return marks;
}

/** The nodes whose result was forced in the tick that is shown. */
function pastMarks(): DebugMarks['forced'] {
  const { shown, tree } = useMoment.getState();
  if (!shown?.forced.length) return NOTHING;
  const results = new Map<number, NodeStatus>([...shown.statuses, ...shown.flashes]);
  const marks = new Map<LiveKey, ForcedMark>();
  for (const uid of shown.forced) {
    const { tree_id = '', node_id = '' } = tree[uid - 1] ?? {};
    const status = results.get(uid) ?? 'SKIPPED';
    if (status !== 'IDLE')
      marks.set(liveKey(tree_id, node_id), { status, once: false, after: false, alone: false });
  }
  return marks;
}

function forcedMarks(tree: readonly TreeNode[], { nodes, alone }: Forced): DebugMarks['forced'] {
  const marks = new Map<LiveKey, ForcedMark>();
  const put = (uid: number, mark: ForcedMark) => {
    const node = tree[uid - 1];
    if (node) marks.set(liveKey(node.tree_id, node.node_id), mark);
  };
  if (alone) put(alone, { status: 'RUNNING', once: false, after: false, alone: true });
  for (const { uid, status, once, after } of nodes) put(uid, { status, once, after, alone: false });
  return marks;
}
