import type { Poses, Scene } from '@/generated/messages';
import { floatsOf, frames, uint16Of } from './frames';

/** x, y, z, qx, qy, qz, qw */
export type Pose = ArrayLike<number>;

/**
 * The current pose of every object. Pose frames hold only what changed, so a viewer that opens later
 * needs what all of them together said.
 */
export const currentPoses = new Map<number, Pose>();

frames.listen('scene', (scene: Scene) => {
  currentPoses.clear();
  for (const object of scene.objects) currentPoses.set(object.id, object.pose);
});

frames.listen('poses', (frame: Poses) => {
  forEachPose(frame, (id, pose) => currentPoses.set(id, pose));
});

export function forEachPose(frame: Poses, visit: (id: number, pose: Float32Array) => void): void {
  const ids = uint16Of(frame.ids);
  const values = floatsOf(frame.poses);
  ids.forEach((id, index) => visit(id, values.subarray(index * 7, index * 7 + 7)));
}
