import { useReactFlow } from '@xyflow/react';
import { useEffect, useRef } from 'react';
import type { NodeId } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';
import { panToShow } from './clearing';

const MARGIN = 48;
/** The height in px of the canvas's bottom part that the toolbar covers. */
const MARGIN_BELOW = 84;

const canvasOf = (treeId: string) => document.querySelector(`[data-tree="${CSS.escape(treeId)}"]`);

/**
 * Scrolls a block into view on request. A block that is new or selected by keys is scrolled as far as needed:
 * neither outside the view nor below an element that lies on the canvas (`data-overlay`). A tree that is seen as a
 * whole (`isWhole`) shows it already.
 */
export function useReveal(treeId: string, layout: Layout, isWhole = false): void {
  const flow = useReactFlow();
  const revealed = useProjectStore((state) => (state.revealed?.tree === treeId ? state.revealed : null));
  const first = useProjectStore((state) => (state.activeTree === treeId ? state.selection[0] : undefined));
  const boxes = useRef(layout);
  const whole = useRef(isWhole);

  useEffect(() => {
    boxes.current = layout;
    whole.current = isWhole;
  }, [layout, isWhole]);

  useEffect(() => {
    const box = revealed && boxes.current.positions[revealed.node];
    if (!box) return;
    // What only follows the run does not take the whole of the tree away.
    if (whole.current && useProjectStore.getState().selection[0] !== revealed.node) return;
    const show = () =>
      void flow.setCenter(box.x + box.width / 2, box.y + box.height / 2, {
        zoom: Math.max(0.9, flow.getZoom()),
        duration: 200,
      });
    if (canvasOf(treeId)?.clientWidth !== 0) return show();
    // The tab of the tree comes to the front soon. A canvas without a size cannot be moved: its zoom would be
    // NaN. The library knows the size one frame later.
    let frame = requestAnimationFrame(function attempt() {
      frame = requestAnimationFrame(canvasOf(treeId)?.clientWidth === 0 ? attempt : show);
    });
    return () => cancelAnimationFrame(frame);
  }, [revealed, flow, treeId]);

  useEffect(() => {
    const box = boxes.current.positions[first ?? ('' as NodeId)];
    const canvas = canvasOf(treeId);
    if (whole.current || !box || !canvas || canvas.getBoundingClientRect().width === 0) return;
    const start = flow.flowToScreenPosition({ x: box.x, y: box.y });
    const end = flow.flowToScreenPosition({ x: box.x + box.width, y: box.y + box.height });
    const bounds = canvas.getBoundingClientRect();
    const view = {
      x: bounds.left + MARGIN,
      y: bounds.top + MARGIN,
      width: bounds.width - 2 * MARGIN,
      height: bounds.height - MARGIN - MARGIN_BELOW,
    };
    const obstacles = [...canvas.querySelectorAll('[data-overlay]')].map((each) =>
      each.getBoundingClientRect(),
    );
    const block = { ...start, width: end.x - start.x, height: end.y - start.y };
    const { dx, dy } = panToShow(block, view, obstacles);
    if (dx === 0 && dy === 0) return;
    const { x, y, zoom } = flow.getViewport();
    void flow.setViewport({ x: x + dx, y: y + dy, zoom }, { duration: 120 });
  }, [first, layout, treeId, flow]);
}
