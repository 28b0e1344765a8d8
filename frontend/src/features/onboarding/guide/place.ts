export interface Rect {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

export type Side = 'right' | 'left' | 'bottom' | 'top' | 'inside';

export interface Place {
  readonly left: number;
  readonly top: number;
  readonly side: Side;
}

interface Size {
  readonly width: number;
  readonly height: number;
}

const GAP = 14;
const EDGE = 8;

const clamp = (value: number, most: number): number => Math.max(EDGE, Math.min(value, most));

/**
 * Returns the place of a note: on the first side of the target where the note does not cover it, otherwise
 * inside the target.
 */
export function placeBeside(target: Rect, note: Size, room: Size): Place {
  const right = target.left + target.width + GAP;
  const left = target.left - GAP - note.width;
  const below = target.top + target.height + GAP;
  const above = target.top - GAP - note.height;
  const alongX = clamp(target.left + target.width / 2 - note.width / 2, room.width - note.width - EDGE);
  const alongY = clamp(target.top + target.height / 2 - note.height / 2, room.height - note.height - EDGE);
  if (right + note.width + EDGE <= room.width) return { left: right, top: alongY, side: 'right' };
  if (left >= EDGE) return { left, top: alongY, side: 'left' };
  if (below + note.height + EDGE <= room.height) return { left: alongX, top: below, side: 'bottom' };
  if (above >= EDGE) return { left: alongX, top: above, side: 'top' };
  return {
    left: clamp(target.left + target.width - note.width - GAP, room.width - note.width - EDGE),
    top: clamp(target.top + GAP, room.height - note.height - EDGE),
    side: 'inside',
  };
}
