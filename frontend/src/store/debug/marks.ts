import { create } from 'zustand';
import type { Forced, Held, ResultName, TreeNode } from '@/generated/messages';
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

/** The marks of the debugger on the blocks, of the present: none while the page shows the past. */
export const useDebugMarks = create<DebugMarks>(() => ({ held: NO_HOLD, forced: NOTHING }));

/** Keeps the marks as the session tells them. */
export function followMarks(): () => void {
  const show = () => {
    const { tree, held, forced } = useSessionStore.getState();
    const isBack = isLookingBack();
    useDebugMarks.setState({
      held: held && !isBack ? heldMarks(tree, held) : NO_HOLD,
      forced: forced && !isBack ? forcedMarks(tree, forced) : NOTHING,
    });
  };
  show();
  const stops = [
    useSessionStore.subscribe((now, before) => {
      if (now.held !== before.held || now.forced !== before.forced || now.tree !== before.tree) show();
    }),
    useMoment.subscribe((now, before) => {
      if ((now.t === null) !== (before.t === null)) show();
    }),
  ];
  return () => {
    stops.forEach((stop) => stop());
    useDebugMarks.setState({ held: NO_HOLD, forced: NOTHING });
  };
}

function heldMarks(tree: readonly TreeNode[], held: Held): DebugMarks['held'] {
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
