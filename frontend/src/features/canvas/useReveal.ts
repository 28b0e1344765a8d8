import { useReactFlow } from '@xyflow/react';
import { useEffect, useRef } from 'react';
import type { NodeId } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';

const MARGIN = 48;
/** The height of the toolbar that covers the bottom of the canvas, in px. */
const MARGIN_BELOW = 84;

/** Scrolls a block into view on request, or when keys select one that is out of sight. */
export function useReveal(treeId: string, layout: Layout): void {
  const flow = useReactFlow();
  const revealed = useProjectStore((state) => (state.revealed?.tree === treeId ? state.revealed : null));
  const first = useProjectStore((state) => (state.activeTree === treeId ? state.selection[0] : undefined));
  const boxes = useRef(layout);

  useEffect(() => {
    boxes.current = layout;
  }, [layout]);

  useEffect(() => {
    const box = revealed && boxes.current.positions[revealed.node];
    if (!box) return;
    void flow.setCenter(box.x + box.width / 2, box.y + box.height / 2, {
      zoom: Math.max(0.9, flow.getZoom()),
      duration: 200,
    });
  }, [revealed, flow]);

  useEffect(() => {
    const box = boxes.current.positions[first ?? ('' as NodeId)];
    const canvas = document.querySelector(`[data-tree="${CSS.escape(treeId)}"]`)?.getBoundingClientRect();
    if (!box || !canvas || canvas.width === 0) return;
    const start = flow.flowToScreenPosition({ x: box.x, y: box.y });
    const end = flow.flowToScreenPosition({ x: box.x + box.width, y: box.y + box.height });
    const dx = Math.max(0, canvas.left + MARGIN - start.x) - Math.max(0, end.x - (canvas.right - MARGIN));
    const dy =
      Math.max(0, canvas.top + MARGIN - start.y) - Math.max(0, end.y - (canvas.bottom - MARGIN_BELOW));
    if (dx === 0 && dy === 0) return;
    const { x, y, zoom } = flow.getViewport();
    void flow.setViewport({ x: x + dx, y: y + dy, zoom }, { duration: 120 });
  }, [first, layout, treeId, flow]);
}
