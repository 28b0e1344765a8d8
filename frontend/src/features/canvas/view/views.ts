import type { ReactFlowInstance } from '@xyflow/react';
import { useProjectStore } from '@/store/project';
import type { BlockNode, TreeEdge } from '../flow';
import { FIT } from './useViewport';

type View = ReactFlowInstance<BlockNode, TreeEdge>;

const views = new Map<string, View>();

interface Large {
  readonly fit: () => void;
  /** The way into a tree that is seen as a whole; null while its blocks are seen. */
  readonly enter: ((zoom?: number) => void) | null;
}

/** The trees that are too large to be fitted as blocks. */
const large = new Map<string, Large>();
const FAST = { duration: 120 };
const SLOW = { duration: 200 };

/** Connects the view commands to a tree's view; returns a function that disconnects them. */
export function showsTree(treeId: string, view: View): () => void {
  views.set(treeId, view);
  return () => {
    if (views.get(treeId) === view) views.delete(treeId);
  };
}

/** Tells the view commands of a tree that is drawn as a whole when it is fitted; returns a function that ends that. */
export function isTooLarge(treeId: string, tree: Large): () => void {
  large.set(treeId, tree);
  return () => {
    if (large.get(treeId) === tree) large.delete(treeId);
  };
}

const activeTree = (): string => useProjectStore.getState().activeTree ?? '';
const inFront = (): View | undefined => views.get(activeTree());

/** The frame in which the view is fitted by itself. */
let soon = 0;

/** Returns the view for a wish of the user, which no earlier one may override a frame later. */
function wishedFor(): View | undefined {
  cancelAnimationFrame(soon);
  return inFront();
}

export const isTreeShown = (): boolean => inFront() !== undefined;
export function zoomIn(): void {
  const view = wishedFor();
  const enter = large.get(activeTree())?.enter;
  if (enter) enter();
  else void view?.zoomIn(FAST);
}
export const zoomOut = (): void => void wishedFor()?.zoomOut(FAST);
export function zoomReset(): void {
  const view = wishedFor();
  const enter = large.get(activeTree())?.enter;
  if (enter) enter(1);
  else void view?.zoomTo(1, FAST);
}

export function fit(): void {
  const view = wishedFor();
  const tree = large.get(activeTree());
  if (tree) tree.fit();
  else void view?.fitView({ ...FIT, ...SLOW });
}

/** Shows the whole tree once React has drawn its new layout. */
export function fitSoon(): void {
  cancelAnimationFrame(soon);
  soon = requestAnimationFrame(fit);
}

/** Fits the view to the selected blocks. */
export function fitSelection(): void {
  const nodes = useProjectStore.getState().selection.map((id) => ({ id }));
  void wishedFor()?.fitView({ ...FIT, nodes, ...SLOW });
}
