import { create } from 'zustand';
import { isLookingBack } from '@/store/moment/store';
import { liveKey, useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { showTree } from '@/store/project/navigation';
import { useSessionStore } from '@/store/session/store';
import type { TreeNode } from '@/generated/messages';

/** The shortest time between two moves of the view: long enough to read. */
const SHORTEST_MS = 700;
/** A block that runs for less does not move the view. */
const LEAST_RUNNING_MS = 500;

/** Whether the view of the open project follows the running block. */
export const useFollowing = create<{ readonly isOn: boolean }>(() => ({ isOn: false }));

const keyOf = (projectId: string) => `bts.followRunning.${projectId}`;
const isKept = (projectId: string | null) =>
  projectId !== null && localStorage.getItem(keyOf(projectId)) === '1';

export function toggleFollowing(): void {
  const isOn = !useFollowing.getState().isOn;
  const { projectId } = useProjectStore.getState();
  if (projectId !== null) localStorage.setItem(keyOf(projectId), isOn ? '1' : '0');
  useFollowing.setState({ isOn });
}

/** Returns the deepest running block, the first of several: the robot's current activity. */
export function runningBlock(
  nodes: readonly TreeNode[],
  isRunning: (node: TreeNode) => boolean,
): TreeNode | undefined {
  const depths = new Map<number, number>();
  let [found, deepest]: [TreeNode | undefined, number] = [undefined, -1];
  for (const node of nodes) {
    const depth = (depths.get(node.parent) ?? -1) + 1;
    depths.set(node.uid, depth);
    if (depth > deepest && node.node_id !== '' && isRunning(node)) [found, deepest] = [node, depth];
  }
  return found;
}

/** Whether the user writes in a file or in a field of an editor. */
const isWriting = () => (document.activeElement?.closest('.cm-editor') ?? null) !== null;

/**
 * Moves the canvas to the running block while the option is on; returns a function that stops it. The selection
 * and the focus stay, and where a file is in front, so does everything.
 */
export function followRunning(): () => void {
  let shown = '';
  let timer: ReturnType<typeof setTimeout> | undefined;
  const since = new Map<string, number>();

  const note = () => {
    const { statuses } = useLiveStore.getState();
    for (const key of since.keys()) if (statuses.get(key) !== 'RUNNING') since.delete(key);
    for (const [key, status] of statuses)
      if (status === 'RUNNING' && !since.has(key)) since.set(key, performance.now());
  };
  const show = () => {
    timer = undefined;
    if (!useFollowing.getState().isOn || isLookingBack()) return;
    note();
    const until = performance.now() - LEAST_RUNNING_MS;
    const isLong = (node: TreeNode) => (since.get(liveKey(node.tree_id, node.node_id)) ?? Infinity) <= until;
    const found = runningBlock(useSessionStore.getState().tree, isLong);
    const key = found ? liveKey(found.tree_id, found.node_id) : '';
    if (since.size > 0) later(); // a block may run long enough without another change
    if (!found || key === shown || isWriting() || !showTree(found.tree_id)) return;
    shown = key;
    useProjectStore.setState((state) => ({
      revealed: { tree: found.tree_id, node: found.node_id, count: (state.revealed?.count ?? 0) + 1 },
    }));
  };
  const later = () => {
    timer ??= setTimeout(show, SHORTEST_MS);
  };

  useFollowing.setState({ isOn: isKept(useProjectStore.getState().projectId) });
  const stops = [
    useLiveStore.subscribe((state, before) => {
      if (state.statuses === before.statuses || !useFollowing.getState().isOn) return;
      note();
      later();
    }),
    useProjectStore.subscribe(({ projectId }, before) => {
      if (projectId !== before.projectId) useFollowing.setState({ isOn: isKept(projectId) });
    }),
    useFollowing.subscribe(() => {
      shown = '';
      later();
    }),
  ];
  return () => {
    clearTimeout(timer);
    for (const stop of stops) stop();
  };
}
