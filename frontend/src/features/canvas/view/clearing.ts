import type { Box } from '@/model/layout';

export interface Pan {
  readonly dx: number;
  readonly dy: number;
}

/** The distance in px between a block and the elements that lie on the canvas. */
const GAP = 12;

const lies = (box: Box, on: Box): boolean =>
  box.x < on.x + on.width + GAP &&
  box.x + box.width + GAP > on.x &&
  box.y < on.y + on.height + GAP &&
  box.y + box.height + GAP > on.y;

const moved = (box: Box, { dx, dy }: Pan): Box => ({ ...box, x: box.x + dx, y: box.y + dy });

/** Returns the smallest pan that shows a box in a view; if the view is too small, the start of the box. */
function panInto(box: Box, view: Box): Pan {
  const along = (start: number, size: number, from: number, room: number): number =>
    Math.max(0, from - start) || -Math.max(0, Math.min(start + size - (from + room), start - from));
  return {
    dx: along(box.x, box.width, view.x, view.width),
    dy: along(box.y, box.height, view.y, view.height),
  };
}

/** Returns the pans that move a box beside an obstacle, one for each side. */
function pansOff(box: Box, on: Box): Pan[] {
  return [
    { dx: on.x - GAP - (box.x + box.width), dy: 0 },
    { dx: on.x + on.width + GAP - box.x, dy: 0 },
    { dx: 0, dy: on.y - GAP - (box.y + box.height) },
    { dx: 0, dy: on.y + on.height + GAP - box.y },
  ];
}

/**
 * Returns the smallest pan that shows a box in a view with no obstacle covering it; all values in px of the
 * window.
 */
export function panToShow(box: Box, view: Box, obstacles: readonly Box[]): Pan {
  const into = panInto(box, view);
  const shown = moved(box, into);
  const hiding = obstacles.filter((each) => lies(shown, each));
  const isFree = (pan: Pan): boolean => {
    const there = moved(shown, pan);
    const { dx, dy } = panInto(there, view);
    return dx === 0 && dy === 0 && !obstacles.some((each) => lies(there, each));
  };
  const [off] = hiding
    .flatMap((each) => pansOff(shown, each))
    .filter(isFree)
    .sort((a, b) => Math.abs(a.dx) + Math.abs(a.dy) - Math.abs(b.dx) - Math.abs(b.dy));
  return { dx: into.dx + (off?.dx ?? 0), dy: into.dy + (off?.dy ?? 0) };
}
