import type { Point } from '../document/values';
import { hasPath, type ModelThing, type Shape, type Thing } from './types';

/** Rounds to 0.1 mm or 0.1 mrad, and never returns minus zero. */
export const rounded = (value: number): number => Math.round(value * 1e4) / 1e4 + 0;

/** Returns the nearest multiple of a step; 0 means no grid. */
export const snapped = (value: number, step: number): number =>
  step > 0 ? rounded(Math.round(value / step) * step) : rounded(value);

/** Rotates a point about another one, by rad. */
export function turned([x, y]: Point, angle: number, [px, py]: Point): Point {
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  return [px + (x - px) * cos - (y - py) * sin, py + (x - px) * sin + (y - py) * cos];
}

/** Returns the position of a thing on the floor; for a person, the start of the path; of an area, its middle. */
export function positionOf(thing: Thing): Point {
  if (!hasPath(thing)) return [thing.pose[0], thing.pose[1]];
  return thing.section === 'areas' ? middleOf([thing]) : (thing.path[0] ?? [0, 0]);
}

/** Returns the centre of several things on the floor. */
export function middleOf(things: readonly Thing[]): Point {
  const points = things.flatMap((thing) => (hasPath(thing) ? [...thing.path] : [positionOf(thing)]));
  const sum = points.reduce<Point>(([sx, sy], [x, y]) => [sx + x, sy + y], [0, 0]);
  return [sum[0] / Math.max(points.length, 1), sum[1] / Math.max(points.length, 1)];
}

/** Returns a size stretched along a thing's own axes; each part is at least one step of the grid. */
export function stretched(
  shape: Shape,
  size: readonly number[],
  [x, y, z]: readonly number[],
  step: number,
): number[] {
  const by = (value: number | undefined, factor: number | undefined) =>
    Math.max(snapped((value ?? 1) * Math.abs(factor ?? 1), step), step || 0.01);
  const [a, b, c] = size;
  // Round things stay round: both factors across the axis become the one that changed most.
  const round = (factors: (number | undefined)[]) =>
    factors.reduce<number>((most, f = 1) => (Math.abs(f - 1) > Math.abs(most - 1) ? f : most), 1);
  switch (shape) {
    case 'box':
    case 'mesh':
      return [by(a, x), by(b, y), by(c, z)];
    case 'cylinder':
      return [by(a, round([x, y])), by(b, z)];
    case 'sphere':
      return [by(a, round([x, y, z]))];
    case 'plane':
      return [by(a, x), by(b, y)];
    default:
      return [...size];
  }
}

/** Returns the height of the centre of a shape that stands on the floor, in m. */
export function standingHeight({ shape, size }: Pick<ModelThing, 'shape' | 'size'>): number {
  const [a = 1, b = 1, c = 1] = size;
  if (shape === 'box') return rounded(c / 2);
  if (shape === 'cylinder') return rounded(b / 2);
  if (shape === 'sphere') return rounded(a);
  return shape === 'plane' ? 0.003 : 0;
}

/** Returns a wall between two points of the floor: its centre, length, and heading in rad. */
export function wallBetween(
  [x1, y1]: Point,
  [x2, y2]: Point,
): { middle: Point; length: number; yaw: number } {
  return {
    middle: [rounded((x1 + x2) / 2), rounded((y1 + y2) / 2)],
    length: rounded(Math.hypot(x2 - x1, y2 - y1)),
    yaw: rounded(Math.atan2(y2 - y1, x2 - x1)),
  };
}
