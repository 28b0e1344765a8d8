import * as THREE from 'three';
import type { Point } from '@/model/document/values';
import type { ThingScene } from './ThingScene';

const ray = new THREE.Raycaster();

export interface Aimed {
  readonly key: string;
  readonly height: number;
  /** The index of the waypoint under the pointer. */
  readonly waypoint: number | null;
}

type At = Pick<MouseEvent, 'clientX' | 'clientY'>;

function aim(event: At, canvas: HTMLElement, camera: THREE.Camera): void {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const x = ((event.clientX - left) / width) * 2 - 1;
  const y = 1 - ((event.clientY - top) / height) * 2;
  // The camera may have moved since the last picture, which is a while ago where drawing is slow.
  camera.updateMatrixWorld();
  ray.setFromCamera(new THREE.Vector2(x, y), camera);
}

/** Returns the thing under the pointer, with the waypoint if the pointer is on one. */
export function thingAt(
  event: At,
  canvas: HTMLElement,
  camera: THREE.Camera,
  scene: Pick<ThingScene<{ key: string }>, 'group' | 'keyOf'>,
): Aimed | null {
  aim(event, canvas, camera);
  scene.group.updateMatrixWorld();
  const hits = ray.intersectObject(scene.group).filter(({ object }) => object.visible);
  // A waypoint's handle is small and lies on the floor, so it takes precedence over objects in front of it.
  const hit = hits.find(({ object }) => object.userData['waypoint'] !== undefined) ?? hits[0];
  const key = hit ? scene.keyOf(hit.object) : null;
  if (!hit || key === null) return null;
  const waypoint: unknown = hit.object.userData['waypoint'];
  return { key, height: hit.point.z, waypoint: typeof waypoint === 'number' ? waypoint : null };
}

/** Returns the position under the pointer at a height above the floor, in m. */
export function pointAt(event: At, canvas: HTMLElement, camera: THREE.Camera, height = 0): Point | null {
  aim(event, canvas, camera);
  const plane = new THREE.Plane(new THREE.Vector3(0, 0, 1), -height);
  const point = ray.ray.intersectPlane(plane, new THREE.Vector3());
  return point ? [point.x, point.y] : null;
}

const FORWARD: readonly Point[] = [
  [1, 0],
  [0, 1],
  [-1, 0],
  [0, -1],
];

/** Returns the world axis that points away from the camera. */
export function forwardOf(camera: THREE.Camera): Point {
  const ahead = camera.getWorldDirection(new THREE.Vector3());
  // When the camera looks straight down, the upper edge of the screen is ahead.
  if (Math.hypot(ahead.x, ahead.y) < 0.05) ahead.set(0, 1, 0).applyQuaternion(camera.quaternion);
  return FORWARD.reduce((best, axis) =>
    axis[0] * ahead.x + axis[1] * ahead.y > best[0] * ahead.x + best[1] * ahead.y ? axis : best,
  );
}
