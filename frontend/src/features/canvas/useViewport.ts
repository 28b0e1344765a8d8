import type { ReactFlowInstance, Viewport } from '@xyflow/react';
import { useCallback, useMemo } from 'react';
import type { NodeId } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { disconnect } from '@/store/project/commands';
import type { BlockNode, TreeEdge } from './flow';

/** Where the user was looking in each tree, for as long as the page lives. */
const viewports = new Map<string, Viewport>();

export const FIT = { padding: 0.14, maxZoom: 1.1, minZoom: 0.3 } as const;

export function useViewport(treeId: string, layout: Layout) {
  const known = viewports.get(treeId);
  const isEmpty = layout.width === 0;
  const initial = useMemo(() => known ?? { x: 80, y: 80, zoom: 1 }, [known]);

  const onInit = useCallback(
    (flow: ReactFlowInstance<BlockNode, TreeEdge>) => {
      if (!viewports.has(treeId) && !isEmpty) void flow.fitView(FIT);
    },
    [treeId, isEmpty],
  );

  const onMoveEnd = useCallback(
    (_event: unknown, viewport: Viewport) => {
      viewports.set(treeId, viewport);
    },
    [treeId],
  );

  /** Cuts a block off its parent, leaving it where it is drawn. */
  const cut = useCallback((id: NodeId, { positions }: Layout) => {
    const box = positions[id];
    disconnect(id, [box?.x ?? 0, (box?.y ?? 0) + 24]);
  }, []);

  return { initial, onInit, onMoveEnd, cut };
}
