import type { ReactFlowInstance } from '@xyflow/react';
import { useProjectStore } from '@/store/project';
import type { BlockNode, TreeEdge } from '../flow';
import { FIT } from './useViewport';

type View = ReactFlowInstance<BlockNode, TreeEdge>;

const views = new Map<string, View>();
const FAST = { duration: 120 };
const SLOW = { duration: 200 };

/** Connects the view commands to a tree's view; returns a function that disconnects them. */
export function showsTree(treeId: string, view: View): () => void {
  views.set(treeId, view);
  return () => {
    if (views.get(treeId) === view) views.delete(treeId);
  };
}

const inFront = (): View | undefined => views.get(useProjectStore.getState().activeTree ?? '');

/** The frame in which the view is fitted by itself. */
let soon = 0;

/** Returns the view for a wish of the user, which no earlier one may override a frame later. */
function wishedFor(): View | undefined {
  cancelAnimationFrame(soon);
  return inFront();
}

export const isTreeShown = (): boolean => inFront() !== undefined;
export const zoomIn = (): void => void wishedFor()?.zoomIn(FAST);
export const zoomOut = (): void => void wishedFor()?.zoomOut(FAST);
export const zoomReset = (): void => void wishedFor()?.zoomTo(1, FAST);
export const fit = (): void => void wishedFor()?.fitView({ ...FIT, ...SLOW });

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
