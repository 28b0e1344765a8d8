import { useReactFlow, useStoreApi } from '@xyflow/react';
import { useCallback } from 'react';
import type { Diagram, NodeId } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { drawnAt, viewOf } from './entered';

const ENTER_MS = 200;
/** The zoom at which the way to a part begins, of that at which it ends. */
const FROM = 0.75;

const isCalm = () => window.matchMedia('(prefers-reduced-motion: reduce)').matches;

/**
 * Returns a function that leads from the whole of a tree to a block and what is below it. Only the last step of the
 * way is shown: a flight over the tree would draw every block that it passes.
 */
export function useEnter(
  { diagram, layout }: { readonly diagram: Diagram; readonly layout: Layout },
  onEntered: (id: NodeId) => void,
): (id: NodeId | null, zoom?: number) => void {
  const flow = useReactFlow();
  const store = useStoreApi();
  return useCallback(
    (id, zoom) => {
      const wanted = drawnAt(diagram, layout, id ?? diagram.root ?? diagram.drafts[0] ?? '');
      const { width, height } = store.getState();
      const view = wanted === null ? null : viewOf(diagram, layout, wanted, { width, height }, zoom);
      if (wanted === null || !view) return;
      const [x, y] = [width / 2, height / 2];
      const from = { x: x + (view.x - x) * FROM, y: y + (view.y - y) * FROM, zoom: view.zoom * FROM };
      if (!isCalm()) void flow.setViewport(from);
      void flow.setViewport(view, isCalm() ? {} : { duration: ENTER_MS });
      onEntered(wanted);
    },
    [diagram, layout, flow, store, onEntered],
  );
}
