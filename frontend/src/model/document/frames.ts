import type { Pose, Vector } from './values';

/** A position and orientation: three rows of a rotation matrix, and an origin. */
interface Frame {
  readonly rows: readonly [Vector, Vector, Vector];
  readonly origin: Vector;
}

const { sin, cos } = Math;

function frameOf([x, y, z, roll, pitch, yaw]: Pose): Frame {
  const [sr, cr, sp, cp, sy, cy] = [sin(roll), cos(roll), sin(pitch), cos(pitch), sin(yaw), cos(yaw)];
  return {
    rows: [
      [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
      [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
      [-sp, cp * sr, cp * cr],
    ],
    origin: [x, y, z],
  };
}

function poseOf({ rows: [a, b, c], origin }: Frame): Pose {
  // With a pitch of ±90°, roll and yaw turn about the same axis: the whole turn counts as yaw.
  const isPole = Math.abs(c[0]) > 1 - 1e-12;
  const pitch = Math.asin(Math.min(1, Math.max(-1, -c[0])));
  const roll = isPole ? 0 : Math.atan2(c[1], c[2]);
  const yaw = isPole ? Math.atan2(-a[1], b[1]) : Math.atan2(b[0], a[0]);
  return [...origin, roll, pitch, yaw];
}

const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const columns = ([a, b, c]: Frame['rows']): [Vector, Vector, Vector] => [
  [a[0], b[0], c[0]],
  [a[1], b[1], c[1]],
  [a[2], b[2], c[2]],
];

const rotated = (rows: Frame['rows'], v: Vector): Vector => [
  dot(rows[0], v),
  dot(rows[1], v),
  dot(rows[2], v),
];

function product(a: Frame, b: Frame): Frame {
  const across = columns(b.rows);
  const row = (r: Vector): Vector => [dot(r, across[0]), dot(r, across[1]), dot(r, across[2])];
  const [x, y, z] = rotated(a.rows, b.origin);
  return {
    rows: [row(a.rows[0]), row(a.rows[1]), row(a.rows[2])],
    origin: [x + a.origin[0], y + a.origin[1], z + a.origin[2]],
  };
}

function inverted({ rows, origin }: Frame): Frame {
  const turned = columns(rows);
  const [x, y, z] = rotated(turned, origin);
  return { rows: turned, origin: [-x, -y, -z] };
}

export const HERE: Pose = [0, 0, 0, 0, 0, 0];

/** Transforms `inner`, a pose in the frame of `outer`, into the frame in which `outer` is given. */
export const within = (outer: Pose, inner: Pose): Pose => poseOf(product(frameOf(outer), frameOf(inner)));

/** Transforms a pose into the frame of `outer`. */
export const seenFrom = (outer: Pose, pose: Pose): Pose =>
  poseOf(product(inverted(frameOf(outer)), frameOf(pose)));

/** Rotates a direction from a pose's own frame into the frame in which the pose is given. */
export const directed = (pose: Pose, direction: Vector): Vector => rotated(frameOf(pose).rows, direction);
