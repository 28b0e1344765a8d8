import type { TryOutcome } from '@/generated/messages';

type Point = readonly [number, number];

/** The room around the paths, in m. */
const MARGIN_M = 1;

/** Returns the part of the world that shows all paths: [left, top, width, height] in m, y downwards. */
export function viewOf(outcomes: readonly TryOutcome[]): readonly [number, number, number, number] | null {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const { paths } of outcomes)
    for (const path of Object.values(paths))
      for (const [, x, y] of path) {
        [left, right] = [Math.min(left, x), Math.max(right, x)];
        [low, high] = [Math.min(low, y), Math.max(high, y)];
      }
  if (left > right) return null;
  const width = right - left + 2 * MARGIN_M;
  return [left - MARGIN_M, -high - MARGIN_M, width, high - low + 2 * MARGIN_M];
}

/** Returns the points of a line of SVG; y points upwards in the world. */
export const pointsOf = (points: readonly Point[]): string => points.map(([x, y]) => `${x},${-y}`).join(' ');
