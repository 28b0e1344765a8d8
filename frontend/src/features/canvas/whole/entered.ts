import type { Viewport } from '@xyflow/react';
import { subtreeOf, type Diagram, type NodeId } from '@/model/diagram';
import type { Box, Layout } from '@/model/layout';
import type { Room } from '@/model/nested';
import { boundsOf } from '../view/overview';
import { atRoot, READABLE } from '../view/useViewport';

/** The free room around a part that is shown as a whole, in px: breadcrumbs and tools lie on the canvas. */
const MARGIN = { x: 40, y: 64 } as const;
const LARGEST = 1;

/** Returns a block that is drawn: the block itself, or the folded one above it that hides it. */
export function drawnAt(diagram: Diagram, { positions }: Layout, id: NodeId): NodeId | null {
  if (id in positions) return id;
  const hiding = Object.keys(positions).find(
    (each) => diagram.nodes[each]?.collapsed && subtreeOf(diagram, each).includes(id),
  );
  return hiding ?? null;
}

/**
 * Returns the view that shows a block and all below it, if that can be read at once; otherwise the block at the edge
 * from which its tree grows. With a `zoom`, the block itself is shown at it.
 */
export function viewOf(
  diagram: Diagram,
  { positions }: Layout,
  id: NodeId,
  room: Room,
  zoom?: number,
): Viewport | null {
  const own = positions[id];
  if (!own) return null;
  const centred = (box: Box, at: number): Viewport => ({
    x: room.width / 2 - (box.x + box.width / 2) * at,
    y: room.height / 2 - (box.y + box.height / 2) * at,
    zoom: at,
  });
  if (zoom !== undefined) return centred(own, zoom);
  const boxes = subtreeOf(diagram, id).map((each) => positions[each]);
  const all = boundsOf(boxes.filter((box) => box !== undefined));
  const fits = Math.min(
    (room.width - 2 * MARGIN.x) / all.width,
    (room.height - 2 * MARGIN.y) / all.height,
    LARGEST,
  );
  if (fits < READABLE) return atRoot(room, own, diagram.layout === 'horizontal');
  return centred(all, fits);
}
