import type { MovedAt, PosesAt } from './types';

/** A frame `poses` of the stream: the ids, and 16 bytes for each. */
export interface PosesFrame {
  readonly t: number;
  readonly ids: Uint16Array;
  readonly poses: Uint8Array;
}

const POSE_BYTES = 16;
const METRES_PER_UNIT = 1e-4;
const TURN_PER_UNIT = 1 / (32767 * Math.SQRT2);
/** An object paused for a longer time did not move, and over a longer way it was put elsewhere. */
const LONGEST_S = 0.2;
const LONGEST_M = 1;
/** Less is the rounding of poses, or a body that settles. */
const LEAST_M = 1e-3;
const LEAST_DEGREES = 0.5;

export type Pose = readonly [number, number, number, number, number, number, number];

export function unpackPose(bytes: Uint8Array, from: number): Pose {
  const view = new DataView(bytes.buffer, bytes.byteOffset + from, POSE_BYTES);
  const pose = [0, 0, 0, 0, 0, 0, 0] as [number, number, number, number, number, number, number];
  for (let axis = 0; axis < 3; axis += 1)
    pose[axis] = ((view.getInt8(3 * axis + 2) << 16) | view.getUint16(3 * axis, true)) * METRES_PER_UNIT;
  const largest = view.getUint8(9) & 3;
  let rest = 1;
  for (let part = 0, read = 10; part < 4; part += 1) {
    if (part === largest) continue;
    const value = view.getInt16(read, true) * TURN_PER_UNIT;
    pose[3 + part] = value;
    rest -= value * value;
    read += 2;
  }
  pose[3 + largest] = Math.sqrt(Math.max(0, rest));
  return pose;
}

export function packPose(pose: ArrayLike<number>, into: Uint8Array, from: number): void {
  const view = new DataView(into.buffer, into.byteOffset + from, POSE_BYTES);
  for (let axis = 0; axis < 3; axis += 1) {
    const units = Math.round((pose[axis] ?? 0) / METRES_PER_UNIT);
    view.setUint16(3 * axis, units & 0xffff, true);
    view.setInt8(3 * axis + 2, units >> 16);
  }
  const turn = [pose[3] ?? 0, pose[4] ?? 0, pose[5] ?? 0, pose[6] ?? 1];
  const sizes = turn.map(Math.abs);
  const largest = sizes.indexOf(Math.max(...sizes));
  const sign = (turn[largest] ?? 1) < 0 ? -1 : 1;
  view.setUint8(9, largest);
  let write = 10;
  turn.forEach((value, part) => {
    if (part === largest) return;
    view.setInt16(write, Math.round((sign * value) / TURN_PER_UNIT), true);
    write += 2;
  });
}

/** Returns the pose a share of the way from one to another. */
export function between(a: Pose, b: Pose, share: number): Pose {
  const dot = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6];
  const sign = dot < 0 ? -1 : 1;
  const mixed = a.map((value, part) => {
    const other = (b[part] ?? 0) * (part < 3 ? 1 : sign);
    return value + (other - value) * share;
  });
  const [x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1] = mixed;
  const size = Math.hypot(qx, qy, qz, qw) || 1;
  return [x, y, z, qx / size, qy / size, qz / size, qw / size];
}

/**
 * Returns the poses of all objects at a time, from the frames of a segment.
 *
 * @param begin the place of a frame up to that time that has all poses, as the first one has.
 */
export function posesAt(frames: readonly PosesFrame[], t: number, begin = 0): PosesAt | null {
  const before = new Map<number, { frame: PosesFrame; at: number }>();
  let next = begin;
  for (; next < frames.length; next += 1) {
    const frame = frames[next];
    if (!frame || (frame.t > t && next > begin)) break;
    frame.ids.forEach((id, index) => before.set(id, { frame, at: index * POSE_BYTES }));
  }
  if (before.size === 0) return null;
  const after = new Map<number, { frame: PosesFrame; at: number }>();
  for (; next < frames.length; next += 1) {
    const frame = frames[next];
    if (!frame || frame.t > t + LONGEST_S) break;
    frame.ids.forEach((id, index) => after.has(id) || after.set(id, { frame, at: index * POSE_BYTES }));
  }
  const ids = Uint16Array.from(before.keys());
  const poses = new Uint8Array(ids.length * POSE_BYTES);
  [...before].forEach(([id, { frame, at }], index) => {
    poses.set(frame.poses.subarray(at, at + POSE_BYTES), index * POSE_BYTES);
    const then = after.get(id);
    if (!then || frame.t >= t || then.frame.t - frame.t > LONGEST_S) return;
    const from = unpackPose(frame.poses, at);
    const to = unpackPose(then.frame.poses, then.at);
    if (Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) > LONGEST_M) return;
    packPose(between(from, to, (t - frame.t) / (then.frame.t - frame.t)), poses, index * POSE_BYTES);
  });
  return { ids: new Uint8Array(ids.buffer), poses };
}

/** Returns the bodies whose poses differ. */
export function moved(from: PosesAt | null, to: PosesAt | null): MovedAt[] {
  if (!from || !to) return [];
  const before = unpacked(from);
  return [...unpacked(to)].flatMap(([id, b]): MovedAt[] => {
    const a = before.get(id);
    if (!a) return [];
    const metres = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    const dot = Math.abs(a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6]);
    const degrees = (2 * Math.acos(Math.min(1, dot)) * 180) / Math.PI;
    return metres < LEAST_M && degrees < LEAST_DEGREES ? [] : [{ id, metres, degrees }];
  });
}

function unpacked({ ids, poses }: PosesAt): Map<number, Pose> {
  const list = new Uint16Array(ids.slice().buffer);
  return new Map(Array.from(list, (id, at) => [id, unpackPose(poses, at * POSE_BYTES)]));
}
