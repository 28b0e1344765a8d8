import type { Box } from '@/model/layout';

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** The scale of a small picture of a tree, and the offset of the tree's top left corner. */
export interface Shrinking {
  readonly sx: number;
  readonly sy: number;
  readonly left: number;
  readonly top: number;
}

const MARGIN = 6;
/** The scales below which blocks would be hairlines: then the tree is stretched to fill the room. */
const LEGIBLE = { sx: 0.03, sy: 0.09 } as const;

/**
 * Fits a tree into a small picture. A tree that is much wider than high, or the reverse, is stretched on its
 * short side, so that its blocks stay visible.
 */
export function shrink(bounds: Box, picture: Size): Shrinking {
  const width = picture.width - 2 * MARGIN;
  const height = picture.height - 2 * MARGIN;
  const [fitX, fitY] = [width / Math.max(1, bounds.width), height / Math.max(1, bounds.height)];
  const even = Math.min(fitX, fitY, 0.2);
  const sx = Math.min(fitX, Math.max(even, LEGIBLE.sx));
  const sy = Math.min(fitY, Math.max(even, LEGIBLE.sy));
  return {
    sx,
    sy,
    left: MARGIN + (width - bounds.width * sx) / 2 - bounds.x * sx,
    top: MARGIN + (height - bounds.height * sy) / 2 - bounds.y * sy,
  };
}

/** Returns the bounding box of several boxes. */
export function boundsOf(boxes: Iterable<Box>): Box {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { x, y, width, height } of boxes) {
    left = Math.min(left, x);
    top = Math.min(top, y);
    right = Math.max(right, x + width);
    bottom = Math.max(bottom, y + height);
  }
  return left === Infinity
    ? { x: 0, y: 0, width: 0, height: 0 }
    : { x: left, y: top, width: right - left, height: bottom - top };
}

/** The smallest size in px of the view's frame, so that it can still be dragged. */
const LEAST = 6;

/** Returns the part of a view that lies in the picture, in the picture's coordinates. */
export function frameOf(view: Box, { sx, sy, left, top }: Shrinking, picture: Size): Box {
  const span = (from: number, to: number, end: number): [number, number] => {
    const middle = Math.max(LEAST / 2, Math.min(end - LEAST / 2, (from + to) / 2));
    const start = Math.max(0, Math.min(from, middle - LEAST / 2));
    return [start, Math.min(end, Math.max(to, middle + LEAST / 2)) - start];
  };
  const [x, width] = span(left + view.x * sx, left + (view.x + view.width) * sx, picture.width);
  const [y, height] = span(top + view.y * sy, top + (view.y + view.height) * sy, picture.height);
  return { x, y, width, height };
}
