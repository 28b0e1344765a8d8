import { directed } from '../document/frames';
import type { Pose, Vector } from '../document/values';
import type { Link, Solid, UrdfShape } from './urdf';

/** A visual shape of a link, a collision shape, or one shape that is both. */
export interface Body {
  readonly visual: Solid | null;
  readonly collision: Solid | null;
}

const near = (a: readonly number[], b: readonly number[]): boolean =>
  a.length === b.length && a.every((part, index) => Math.abs(part - (b[index] ?? NaN)) < 1e-9);

const isSame = (a: Solid, b: Solid): boolean =>
  a.shape === b.shape && a.file === b.file && near(a.size, b.size) && near(a.pose, b.pose);

/** Returns the shapes of a link; a visual and a collision shape in the same place count as one. */
export function bodiesOf(link: Link): Body[] {
  const left = [...link.collisions];
  const seen = link.visuals.map((visual): Body => {
    const at = left.findIndex((collision) => isSame(visual, collision));
    return { visual, collision: at < 0 ? null : (left.splice(at, 1)[0] ?? null) };
  });
  return [...seen, ...left.map((collision): Body => ({ visual: null, collision }))];
}

export const solidOf = ({ visual, collision }: Body): Solid => (visual ?? collision) as Solid;

const AXES: readonly Vector[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Returns half the extent of a shape along its own axes, in m. */
function halves({ shape, size }: Pick<Solid, 'shape' | 'size'>): Vector {
  const [a = 0, b = 0, c = 0] = size;
  if (shape === 'box') return [a / 2, b / 2, c / 2];
  if (shape === 'sphere') return [a, a, a];
  if (shape === 'cylinder') return [a, a, b / 2];
  return shape === 'capsule' ? [a, a, a + b / 2] : [0, 0, 0];
}

/** Returns the bounding box of a link's shapes, in its frame; meshes count as points. */
export function extentOf(link: Link): { low: Vector; high: Vector } {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const solid of [...link.visuals, ...link.collisions]) {
    const half = halves(solid);
    const sides = AXES.map((axis) => directed(solid.pose, axis));
    for (const at of [0, 1, 2] as const) {
      const reach = sides.reduce((sum, side, index) => sum + Math.abs(side[at]) * (half[index] ?? 0), 0);
      low[at] = Math.min(low[at], solid.pose[at] - reach);
      high[at] = Math.max(high[at], solid.pose[at] + reach);
    }
  }
  return Number.isFinite(low[0]) ? { low, high } : { low: [0, 0, 0], high: [0, 0, 0] };
}

export type Inertia = readonly [xx: number, xy: number, xz: number, yy: number, yz: number, zz: number];

/** Returns the inertia of a solid shape of a given mass in kg about its centre, in the axes of its link. */
export function inertiaOf(solid: Pick<Solid, 'shape' | 'size' | 'pose'>, mass: number): Inertia {
  const [x, y, z] = halves(solid);
  const isRound = solid.shape === 'cylinder' || solid.shape === 'capsule';
  const own: Vector =
    solid.shape === 'sphere'
      ? [0.4 * x * x, 0.4 * x * x, 0.4 * x * x]
      : isRound
        ? [(x * x) / 4 + (z * z) / 3, (x * x) / 4 + (z * z) / 3, (x * x) / 2]
        : [(y * y + z * z) / 3, (x * x + z * z) / 3, (x * x + y * y) / 3];
  const sides = AXES.map((axis) => directed(solid.pose, axis));
  const at = (i: 0 | 1 | 2, j: 0 | 1 | 2) =>
    mass * sides.reduce((sum, side, index) => sum + (own[index] ?? 0) * side[i] * side[j], 0);
  return [at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)];
}

/**
 * Scales a size by one factor for the parts along an axis of the link, and another for the parts across it.
 */
export function grown(
  solid: Solid,
  axis: Vector,
  along: number,
  across: number,
): { size: number[]; pose: Pose } {
  const factors = AXES.map((own) => {
    const side = directed(solid.pose, own);
    return Math.abs(side[0] * axis[0] + side[1] * axis[1] + side[2] * axis[2]) > 0.7 ? along : across;
  });
  const [fx = 1, fy = 1, fz = 1] = factors;
  const [a = 0, b = 0, c = 0] = solid.size;
  const sizes: Readonly<Record<UrdfShape, number[]>> = {
    box: [a * fx, b * fy, c * fz],
    mesh: [a * fx, b * fy, c * fz],
    sphere: [a * across],
    cylinder: [a * (fz === along ? across : Math.max(fx, fy)), b * fz],
    capsule: [a * (fz === along ? across : Math.max(fx, fy)), b * fz],
  };
  const [x, y, z, ...turn] = solid.pose;
  const far = x * axis[0] + y * axis[1] + z * axis[2];
  const moved = ([x, y, z] as const).map((part, index) => {
    const own = far * (axis[index] ?? 0);
    return own * along + (part - own) * across;
  });
  const [px = 0, py = 0, pz = 0] = moved;
  return { size: sizes[solid.shape], pose: [px, py, pz, ...turn] };
}
