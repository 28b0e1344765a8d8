import type { Poses, Scene } from '@/generated/messages';
import { frames, uint16Of } from './frames';

/** The position in m and the orientation as a quaternion: x, y, z, qx, qy, qz, qw. */
export type Pose = ArrayLike<number>;

/**
 * The current pose of every object. A frame contains only changed poses, so a viewer that opens later needs
 * this collection.
 */
export const currentPoses = new Map<number, Pose>();

frames.listen('scene', (scene: Scene) => {
  currentPoses.clear();
  for (const object of scene.objects) currentPoses.set(object.id, object.pose);
});

frames.listen('poses', (frame: Poses) => {
  forEachPose(frame, (id, pose) => currentPoses.set(id, pose));
});

const POSE_BYTES = 16;
const METRES_PER_UNIT = 1e-4;
const TURN_PER_UNIT = 1 / (32767 * Math.SQRT2);

/** Calls `visit` with each pose of a frame; `executor/stream/pose_codec.py` defines the packing. */
export function forEachPose(frame: Poses, visit: (id: number, pose: Float32Array) => void): void {
  const { buffer, byteOffset, byteLength } = frame.poses;
  const bytes = new DataView(buffer, byteOffset, byteLength);
  uint16Of(frame.ids).forEach((id, index) => visit(id, unpacked(bytes, index * POSE_BYTES)));
}

function unpacked(bytes: DataView, at: number): Float32Array {
  const pose = new Float32Array(7);
  for (let axis = 0; axis < 3; axis += 1) {
    const low = bytes.getUint16(at + 3 * axis, true);
    pose[axis] = ((bytes.getInt8(at + 3 * axis + 2) << 16) | low) * METRES_PER_UNIT;
  }
  const largest = bytes.getUint8(at + 9);
  let rest = 1;
  for (let part = 0, read = at + 10; part < 4; part += 1) {
    if (part === largest) continue;
    const value = bytes.getInt16(read, true) * TURN_PER_UNIT;
    pose[3 + part] = value;
    rest -= value * value;
    read += 2;
  }
  pose[3 + largest] = Math.sqrt(Math.max(0, rest));
  return pose;
}
