import type { Box } from '@/model/layout';

export interface PictureFrame extends Box {
  /** The side on which the tree continues outside of the picture; null if there is none. */
  readonly cropped: 'bottom' | 'right' | null;
}

const MARGIN = 16;
/** The largest part of a tree that a card shows, in layout units: a larger part would be dots. */
const LARGEST = { width: 1500, height: 720 } as const;

/**
 * Returns the part of a tree that its small picture shows: the whole tree, or its top with the root in the
 * middle.
 */
export function pictureFrame(boxes: readonly Box[], root: Box, isVertical: boolean): PictureFrame {
  const left = Math.min(...boxes.map(({ x }) => x)) - MARGIN;
  const top = Math.min(...boxes.map(({ y }) => y)) - MARGIN;
  const width = Math.max(...boxes.map((box) => box.x + box.width)) + MARGIN - left;
  const height = Math.max(...boxes.map((box) => box.y + box.height)) + MARGIN - top;
  if (width <= LARGEST.width && height <= LARGEST.height) {
    return { x: left, y: top, width, height, cropped: null };
  }
  const shown = { width: Math.min(width, LARGEST.width), height: Math.min(height, LARGEST.height) };
  // The frame stays within the tree, however far to the side the root is.
  const within = (middle: number, size: number, start: number, all: number) =>
    Math.min(Math.max(middle - size / 2, start), start + all - size);
  return isVertical
    ? { ...shown, x: within(root.x + root.width / 2, shown.width, left, width), y: top, cropped: 'bottom' }
    : { ...shown, x: left, y: within(root.y + root.height / 2, shown.height, top, height), cropped: 'right' };
}

/** Returns whether a part of a box is inside of the frame. */
export const isInside = (frame: Box, box: Box): boolean =>
  box.x < frame.x + frame.width &&
  box.x + box.width > frame.x &&
  box.y < frame.y + frame.height &&
  box.y + box.height > frame.y;
