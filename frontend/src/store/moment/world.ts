import type { Camera, Poses, Scan, Scene } from '@/generated/messages';
import { packPose, unpackPose } from '@/store/recording/posesAt';
import type { Moment, PictureAt, ScanAt } from '@/store/recording/types';
import { frames, shownFrames } from '@/store/session/frames';
import { currentPoses } from '@/store/session/poses';

type Quaternion = readonly [number, number, number, number];

/**
 * Shows the world of a moment in 3D and camera views.
 *
 * @param recorded the world of a run that is not the present one; null: the present one.
 */
export function showWorld({ t, poses, scan, pictures }: Moment, recorded: Scene | null = null): void {
  const scene = recorded ?? frames.scene();
  const shown: (Poses | Scan | Camera)[] = [];
  if (poses) shown.push({ type: 'poses', t, ids: poses.ids, poses: poses.poses });
  if (scan && scene) {
    const frame = scanFrame(scan, scene, poses);
    if (frame) shown.push(frame);
  }
  for (const picture of pictures) shown.push(cameraFrame(picture, scene));
  shownFrames.hold(shown, recorded);
}

/** Shows the world as it is now. */
export function showPresentWorld(): void {
  const ids = Uint16Array.from(currentPoses.keys());
  const poses = new Uint8Array(ids.length * 16);
  [...currentPoses.values()].forEach((pose, at) => packPose(pose, poses, at * 16));
  shownFrames.letGo({ type: 'poses', t: frames.newest(), ids: new Uint8Array(ids.buffer), poses });
}

/** Returns a recorded scan as the stream sends it: with the pose of its sensor in the world. */
export function scanFrame(scan: ScanAt, scene: Scene, poses: Moment['poses']): Scan | null {
  const lidars = scene.sensors.filter(({ kind }) => kind === 'lidar');
  const sensor = lidars.find(({ name }) => name === scan.sensor) ?? lidars[0];
  if (!sensor || !poses) return null;
  const ids = new Uint16Array(poses.ids.slice().buffer);
  const place = ids.indexOf(sensor.object_id);
  if (place < 0) return null;
  return {
    type: 'scan',
    t: scan.t,
    sensor: sensor.name,
    pose: composed(unpackPose(poses.poses, place * 16), sensor.pose),
    angle_min: scan.angleMin,
    angle_increment: scan.angleIncrement,
    range_max: scan.rangeMax,
    ranges: new Uint8Array(scan.ranges.buffer, scan.ranges.byteOffset, scan.ranges.byteLength),
  };
}

/** Returns a recorded picture as the stream sends it; the topic names the camera. */
export function cameraFrame({ t, topic, jpeg }: PictureAt, scene: Scene | null): Camera {
  const name = topic.replace(/^\/world\/camera\/|\/compressed$/g, '').replace(/^\/|\/image(_raw)?$/g, '');
  const cameras = scene?.sensors.filter(({ kind }) => kind === 'camera') ?? [];
  const sensor = cameras.find((camera) => camera.name === name)?.name ?? cameras[0]?.name ?? name;
  return { type: 'camera', t, sensor, width: 0, height: 0, jpeg };
}

/** Returns whether a moment has a picture of a camera; null: of any. */
export const hasPicture = ({ pictures }: Moment, sensor: string | null): boolean =>
  pictures.some((picture) => sensor === null || cameraFrame(picture, shownFrames.scene()).sensor === sensor);

/** Returns a pose that is given in the frame of another pose. */
export function composed(outer: ArrayLike<number>, inner: ArrayLike<number>): number[] {
  const [x = 0, y = 0, z = 0, ...turn] = Array.from(outer);
  const [ix = 0, iy = 0, iz = 0, ...innerTurn] = Array.from(inner);
  const q = turn as unknown as Quaternion;
  const [dx, dy, dz] = turned(q, [ix, iy, iz]);
  return [x + dx, y + dy, z + dz, ...product(q, innerTurn as unknown as Quaternion)];
}

function product([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion): Quaternion {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

function turned(q: Quaternion, [x, y, z]: readonly [number, number, number]): [number, number, number] {
  const [qx, qy, qz, qw] = q;
  const [px, py, pz] = product(product(q, [x, y, z, 0]), [-qx, -qy, -qz, qw]);
  return [px, py, pz];
}
