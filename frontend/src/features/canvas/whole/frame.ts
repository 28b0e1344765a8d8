import type { NodeId } from '@/model/diagram';
import type { Box } from '@/model/layout';
import { blockAt, cellOf, type Part } from '@/model/nested';

/** The edge around the picture of a whole tree, in px: breadcrumbs are above it, and the tools below. */
const EDGE = { side: 12, above: 46, below: 58 } as const;
/** Cells from this side on, in px, can be aimed at. */
const AIMED = 6;

/** Returns the place of the picture in a canvas. */
export const frameOf = (width: number, height: number): Box => ({
  x: EDGE.side,
  y: EDGE.above,
  width: Math.max(0, width - 2 * EDGE.side),
  height: Math.max(0, height - EDGE.above - EDGE.below),
});

const holds = (box: Box, x: number, y: number): boolean =>
  x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;

/** Returns the block at a point: the one whose cell is aimed at, or the innermost box. */
export function partAt(parts: readonly Part[], x: number, y: number): NodeId | null {
  // Parents come before their children.
  const part = parts.findLast(({ box }) => holds(box, x, y));
  if (!part) return null;
  const { piece } = part;
  return (piece && piece.cell >= AIMED ? blockAt(piece, x, y) : undefined) ?? part.id;
}

/** Returns the box or the cell of a block. */
export function boxOf(parts: readonly Part[], id: NodeId): Box | null {
  const own = parts.find((part) => part.id === id);
  if (own) return { ...own.box, height: own.title };
  const piece = parts.find((part) => part.piece?.blocks.includes(id))?.piece;
  return piece ? cellOf(piece, piece.blocks.indexOf(id)) : null;
}
