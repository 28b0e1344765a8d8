import * as THREE from 'three';
import type { ShownTrail } from '@/store/session/trace/shownTrail';
import { LIFT_M } from './scene/TrailView';
import type { World } from './scene/World';

const ray = new THREE.Raycaster();
const GROUND = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0);

interface Pointed {
  point: THREE.Vector3;
  /** The id of the object under the pointer; null on the ground. */
  objectId: number | null;
}

function aim(event: PointerEvent, canvas: HTMLElement, camera: THREE.Camera): void {
  const box = canvas.getBoundingClientRect();
  const x = ((event.clientX - box.left) / box.width) * 2 - 1;
  const y = 1 - ((event.clientY - box.top) / box.height) * 2;
  // The camera may have moved since the last picture, which is a while ago where drawing is slow.
  camera.updateMatrixWorld();
  ray.setFromCamera(new THREE.Vector2(x, y), camera);
}

/** Returns the point under the pointer, with the object there: a body of the world, or the ground. */
export function pointedAt(
  event: PointerEvent,
  canvas: HTMLElement,
  camera: THREE.Camera,
  world: World,
): Pointed | null {
  aim(event, canvas, camera);
  const hit = ray.intersectObject(world.group).find(({ object }) => object instanceof THREE.Mesh);
  if (hit) return { point: hit.point, objectId: world.idOf(hit.object) };
  const point = ray.ray.intersectPlane(GROUND, new THREE.Vector3());
  return point ? { point, objectId: null } : null;
}

/** Returns the position under the pointer at a height above the ground, in m. */
export function pointedAtHeight(
  event: PointerEvent,
  canvas: HTMLElement,
  camera: THREE.Camera,
  height: number,
): THREE.Vector3 | null {
  aim(event, canvas, camera);
  return ray.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -height), new THREE.Vector3());
}

/** The distance in pixels at which a click is still on the trail. */
const NEAR_PX = 8;

/** Returns the time of the place of the trail under the pointer, in s; null beside it, or behind a body. */
export function trailMomentAt(
  event: PointerEvent,
  canvas: HTMLElement,
  camera: THREE.Camera,
  world: World,
  trail: Pick<ShownTrail, 'timeNear'>,
): number | null {
  const point = pointedAtHeight(event, canvas, camera, LIFT_M);
  if (!point) return null;
  const withinM = NEAR_PX * metresPerPixel(camera, point, canvas.getBoundingClientRect().height);
  const t = trail.timeNear(point.x, point.y, withinM);
  if (t === null) return null;
  const away = camera.position.distanceTo(point);
  const first = ray.intersectObject(world.group).find(({ object }) => object instanceof THREE.Mesh);
  return first && first.distance < away - 2 * LIFT_M ? null : t;
}

function metresPerPixel(camera: THREE.Camera, point: THREE.Vector3, heightPx: number): number {
  if (!(camera instanceof THREE.PerspectiveCamera)) return 0.01;
  const seenM = 2 * camera.position.distanceTo(point) * Math.tan(THREE.MathUtils.degToRad(camera.fov) / 2);
  return seenM / Math.max(heightPx, 1);
}
