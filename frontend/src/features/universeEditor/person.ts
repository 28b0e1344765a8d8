import type { Shape } from '@/generated/messages';

const SKIN = [0.87, 0.68, 0.55, 1];
const HAIR = [0.2, 0.13, 0.09, 1];
const SHOE = [0.13, 0.12, 0.14, 1];
const LEVEL = [0.70711, 0, 0, 0.70711];

const shape = (
  kind: Shape['shape'],
  size: number[],
  at: readonly [number, number, number],
  color: number[],
  rotation = [0, 0, 0, 1],
): Shape => ({ shape: kind, size, pose: [...at, ...rotation], color });

/**
 * Returns the shapes of a standing person, 1.75 m tall and facing along x, as in
 * `executor/world/geometry/person.py`.
 */
export function personShapes(color: number[]): Shape[] {
  const trousers = [...color.slice(0, 3).map((channel) => channel * 0.8), 1];
  const sides = [1, -1].flatMap((side) => [
    shape('capsule', [0.15, 0.2], [0, side * 0.055, 1.2], color),
    shape('capsule', [0.078, 0.34], [0, side * 0.095, 0.67], trousers),
    shape('capsule', [0.062, 0.34], [0, side * 0.095, 0.3], trousers),
    shape('box', [0.24, 0.09, 0.07], [0.045, side * 0.095, 0.035], SHOE),
    shape('capsule', [0.052, 0.24], [0, side * 0.225, 1.25], color),
    shape('capsule', [0.044, 0.22], [0.01, side * 0.225, 1], color),
    shape('sphere', [0.048], [0.015, side * 0.225, 0.84], SKIN),
  ]);
  return [
    ...sides,
    shape('capsule', [0.055, 0.3], [0, 0, 1.38], color, LEVEL),
    shape('capsule', [0.125, 0.1], [0, 0, 0.93], trousers, LEVEL),
    shape('cylinder', [0.05, 0.12], [0, 0, 1.47], SKIN),
    shape('capsule', [0.092, 0.05], [0.005, 0, 1.615], SKIN),
    shape('capsule', [0.096, 0.03], [-0.018, 0, 1.645], HAIR),
    shape('sphere', [0.018], [0.098, 0, 1.605], SKIN),
  ];
}
