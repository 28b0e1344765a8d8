import { useStoreApi, type ReactFlowInstance, type Viewport } from '@xyflow/react';
import { useCallback, useMemo } from 'react';
import type { Diagram, NodeId } from '@/model/diagram';
import type { Box, Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';
import { disconnect } from '@/store/project/edits/blocks';
import type { BlockNode, TreeEdge } from '../flow';

/** The last view of each tree of each project, with the width of its canvas, until the page closes. */
const viewports = new Map<string, Viewport & { readonly width: number }>();

/** The smallest zoom, which shows the largest tree as a whole. */
export const LEAST_ZOOM = 0.004;

export const FIT = { padding: 0.14, maxZoom: 1.1, minZoom: LEAST_ZOOM } as const;

/** The zoom below which blocks show only their names. */
export const NAMES = 0.65;
/** The zoom below which they show only symbol, colour and status. */
export const FAR = 0.42;

/** The zoom below which the names of blocks are hard to read. */
export const READABLE = 0.6;
const EDGE = 48;

/**
 * Returns the view of a tree that does not fit: its root at a readable zoom, near the edge from which
 * the tree grows.
 */
export function atRoot(
  { width, height }: { width: number; height: number },
  root: Box,
  isHorizontal: boolean,
): Viewport {
  const zoom = READABLE + 0.1;
  return isHorizontal
    ? { x: EDGE - root.x * zoom, y: height / 2 - (root.y + root.height / 2) * zoom, zoom }
    : { x: width / 2 - (root.x + root.width / 2) * zoom, y: EDGE - root.y * zoom, zoom };
}

export function useViewport(treeId: string, layout: Layout, diagram: Diagram) {
  const store = useStoreApi();
  const key = useProjectStore((state) => `${state.projectId ?? ''}/${treeId}`);
  const known = viewports.get(key);
  const isEmpty = layout.width === 0;
  const initial = useMemo(
    () => (known ? { x: known.x, y: known.y, zoom: known.zoom } : { x: 80, y: 80, zoom: 1 }),
    [known],
  );

  const onInit = useCallback(
    (flow: ReactFlowInstance<BlockNode, TreeEdge>) => {
      const pane = store.getState();
      // If the canvas had another width, the stored view may not show the tree.
      if (viewports.get(key)?.width === pane.width || isEmpty) return;
      const fits = Math.min(pane.width / layout.width, pane.height / layout.height) / (1 + FIT.padding);
      const root = layout.positions[diagram.root ?? ''];
      if (fits >= READABLE || !root) void flow.fitView(FIT);
      else void flow.setViewport(atRoot(pane, root, diagram.layout === 'horizontal'));
    },
    [store, key, isEmpty, layout, diagram],
  );

  const onMoveEnd = useCallback(
    (_event: unknown, viewport: Viewport) => {
      viewports.set(key, { ...viewport, width: store.getState().width });
    },
    [store, key],
  );

  /** Disconnects a block from its parent and leaves it where it is drawn. */
  const cut = useCallback((id: NodeId, { positions }: Layout) => {
    const box = positions[id];
    disconnect(id, [box?.x ?? 0, (box?.y ?? 0) + 24]);
  }, []);

  return { initial, onInit, onMoveEnd, cut };
}
