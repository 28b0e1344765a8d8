import { useReactFlow, useStore, useStoreApi, type Viewport } from '@xyflow/react';
import { useEffect, useRef } from 'react';
import type { NodeId } from '@/model/diagram';
import { usePresentation } from '@/workspace/presentation';
import type { BlockNode, TreeEdge } from '../flow';
import type { TreeOnCanvas } from '../useTree';
import { FIT, READABLE } from './useViewport';

const ANIMATED = { ...FIT, duration: 200 };
/**
 * The time in ms within which a fit is finished; changes of size within it belong to the same drag of a
 * panel's edge.
 */
const FITTED_MS = ANIMATED.duration + 300;
/** A tree that grows is kept in view as a whole as long as it fits at this zoom. */
const KEPT = 0.5;
/** In a presentation a small tree is enlarged, to be read from afar. */
const PRESENTED = { ...FIT, maxZoom: 2, duration: 200 };

/** Returns the blocks of the SubTree that was expanded or closed last; null if none was. */
function changedGroup(
  { shown }: TreeOnCanvas,
  before: ReadonlyMap<NodeId, unknown>,
): readonly NodeId[] | null {
  const opened = [...shown.groups.keys()].find((id) => !before.has(id));
  const closed = [...before.keys()].find((id) => !shown.groups.has(id) && id in shown.diagram.nodes);
  const id = opened ?? closed;
  return id === undefined ? null : [id, ...(shown.groups.get(id) ?? [])];
}

/**
 * Fits the view again after a change of the whole picture: the orientation, the compact layout, a SubTree
 * that is expanded or closed, the first block, or a new size of the canvas or of the tree, if all blocks were
 * visible before and are not any more. A presentation always shows all blocks, and restores the earlier view at its end.
 */
export function useRefit(tree: TreeOnCanvas): void {
  const flow = useReactFlow<BlockNode, TreeEdge>();
  const store = useStoreApi();
  const { layout, diagram, shown, isCompact } = tree;
  const isPresented = usePresentation(({ mode }) => mode !== 'off');
  const resting = useRef<Resting | null>(null);
  const width = useStore((state) => state.width);
  const height = useStore((state) => state.height);
  const before = useRef({
    orientation: diagram.layout,
    isCompact,
    groups: shown.groups,
    isPresented,
    width,
    height,
    layout,
  });
  /** The time until which the view is moving to show the whole tree. */
  const aims = useRef(0);

  useEffect(() => {
    const last = before.current;
    const { groups } = shown;
    before.current = { orientation: diagram.layout, isCompact, groups, isPresented, width, height, layout };
    const whole = isPresented ? PRESENTED : ANIMATED;
    const fitSoon = (nodes?: readonly NodeId[]): void => {
      aims.current = nodes ? 0 : performance.now() + FITTED_MS;
      // The view is fitted after React Flow knows the new places.
      requestAnimationFrame(
        () => void flow.fitView(nodes ? { ...whole, nodes: nodes.map((id) => ({ id })) } : whole),
      );
    };
    if (isPresented && !last.isPresented)
      resting.current = { viewport: flow.getViewport(), width: last.width, height: last.height };
    if (last.orientation !== diagram.layout || last.isCompact !== isCompact) return fitSoon();
    if (last.groups !== shown.groups) {
      const group = changedGroup(tree, last.groups);
      const zoom = Math.min(width / layout.width, height / layout.height) / (1 + FIT.padding);
      if (group) fitSoon(zoom >= READABLE ? undefined : group);
      return;
    }
    // The canvas gets its new size after the presentation began or ended.
    if (isPresented && width > 0 && (last.width !== width || last.height !== height)) return fitSoon();
    const rest = resting.current;
    if (!isPresented && rest && rest.width === width && rest.height === height) {
      resting.current = null;
      requestAnimationFrame(() => void flow.setViewport(rest.viewport));
      return;
    }
    if (last.width === 0 || width === 0) return;
    const { transform } = store.getState();
    const isAiming = performance.now() < aims.current;
    if (last.width === width && last.height === height) {
      if (last.layout === layout) return;
      const isFirst = last.layout.width === 0 && layout.width > 0;
      const wasWhole = isAiming || isWhole(last, transform);
      const fits = Math.min(width / layout.width, height / layout.height) / (1 + FIT.padding) >= KEPT;
      if (isFirst || (fits && wasWhole && !isWhole({ width, height, layout }, transform))) fitSoon();
      return;
    }
    if (isAiming || (isWhole(last, transform) && !isWhole({ width, height, layout }, transform))) fitSoon();
  }, [tree, flow, store, layout, diagram, shown, isCompact, isPresented, width, height]);
}

/** The view before a presentation. */
interface Resting {
  readonly viewport: Viewport;
  readonly width: number;
  readonly height: number;
}

interface Seen {
  readonly width: number;
  readonly height: number;
  readonly layout: TreeOnCanvas['layout'];
}

/** Returns whether all blocks are in a view. */
function isWhole({ width, height, layout }: Seen, [x, y, zoom]: readonly [number, number, number]): boolean {
  const boxes = Object.values(layout.positions);
  return (
    boxes.length > 0 &&
    boxes.every(
      (box) =>
        box.x * zoom + x >= 0 &&
        box.y * zoom + y >= 0 &&
        (box.x + box.width) * zoom + x <= width &&
        (box.y + box.height) * zoom + y <= height,
    )
  );
}
