import { create } from 'zustand';
import type { NodeId } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { useMoment } from './store';

/** How the tree as it ran is shown; `source` is the code that its actions ran in the shown tick. */
export type PastView = 'canvas' | 'list' | 'source';

interface PastTree {
  /** The tree that the user chose to see; null: the active one of the project, or the main one of the run. */
  readonly tree: string | null;
  /** The selected block of it. */
  readonly node: NodeId | null;
  readonly view: PastView;
  /** Whether what changed since is marked. */
  readonly isCompared: boolean;
}

const atFirst: PastTree = { tree: null, node: null, view: 'canvas', isCompared: false };

/** The view state of the tree as it ran. No edit depends on it. */
export const usePastTree = create<PastTree>(() => atFirst);

useMoment.subscribe((now, before) => {
  if (now.shown === null && before.shown !== null) usePastTree.setState(atFirst, true);
});

// What leads to a block, such as a step of an answer, leads to it in the tree as it ran, too.
useProjectStore.subscribe(({ revealed }, before) => {
  const { shown, trees } = useMoment.getState();
  if (!shown || !revealed || revealed === before.revealed) return;
  const { tree, node } = revealed;
  if (trees[tree]?.diagram.nodes[node]) usePastTree.setState({ tree, node });
});

/** Returns the recorded tree that is shown; null if the run has none. */
export function shownTree(
  wanted: string | null,
  trees: readonly string[],
  active: string | null,
): string | null {
  for (const id of [wanted, active]) if (id !== null && trees.includes(id)) return id;
  return trees[0] ?? null;
}

/** Selects a block of the tree as it ran, and the same block of the present tree where it exists. */
export function selectPast(tree: string, node: NodeId | null): void {
  usePastTree.setState({ tree, node });
  const { activeTree, diagrams, select } = useProjectStore.getState();
  if (node !== null && diagrams[tree]?.nodes[node]) select(tree, [node]);
  else if (activeTree !== null) select(activeTree, []);
}

/** Shows another tree of the run. */
export const openPastTree = (tree: string): void => usePastTree.setState({ tree, node: null });
