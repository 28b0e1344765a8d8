import { create } from 'zustand';
import { isLookingBack } from '@/store/moment/store';
import { liveKey, useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { useSessionStore } from '@/store/session/store';
import type { TreeNode } from '@/generated/messages';

const KEY = 'bts.followRunning';
/**
 * The shortest time between two moves of the view: short enough to keep up with the run, long enough to read.
 */
const SHORTEST_MS = 700;

export const useFollowing = create<{ isOn: boolean }>(() => ({ isOn: localStorage.getItem(KEY) === '1' }));

export function toggleFollowing(): void {
  const isOn = !useFollowing.getState().isOn;
  localStorage.setItem(KEY, isOn ? '1' : '0');
  useFollowing.setState({ isOn });
}

/** Returns the first running leaf of the tree, which is the robot's current activity. */
export function runningLeaf(
  nodes: readonly TreeNode[],
  isRunning: (node: TreeNode) => boolean,
): TreeNode | undefined {
  const parents = new Set(nodes.filter(isRunning).map((node) => node.parent));
  return nodes.find((node) => node.node_id !== '' && isRunning(node) && !parents.has(node.uid));
}

/**
 * Scrolls the canvas to the running block while the option is on, without changing the selection; returns a
 * function that stops it.
 */
export function followRunning(): () => void {
  let shown = '';
  let timer: ReturnType<typeof setTimeout> | undefined;

  const show = () => {
    timer = undefined;
    if (!useFollowing.getState().isOn || isLookingBack()) return;
    const { statuses } = useLiveStore.getState();
    const isRunning = (node: TreeNode) => statuses.get(liveKey(node.tree_id, node.node_id)) === 'RUNNING';
    const leaf = runningLeaf(useSessionStore.getState().tree, isRunning);
    const key = leaf ? liveKey(leaf.tree_id, leaf.node_id) : '';
    if (!leaf || key === shown) return;
    shown = key;
    openTree(leaf.tree_id);
    useProjectStore.setState((state) => ({
      revealed: { tree: leaf.tree_id, node: leaf.node_id, count: (state.revealed?.count ?? 0) + 1 },
    }));
  };
  const later = () => {
    timer ??= setTimeout(show, SHORTEST_MS);
  };

  const stops = [
    useLiveStore.subscribe((state, before) => {
      if (state.statuses !== before.statuses && useFollowing.getState().isOn) later();
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
