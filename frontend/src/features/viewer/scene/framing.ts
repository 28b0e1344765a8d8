import * as THREE from 'three';

/** The factor that leaves a margin around the framed box. */
const MARGIN = 1.06;

/** Returns the distance in m from a box's centre at which a camera in a direction sees the whole box. */
export function framingDistance(
  camera: THREE.PerspectiveCamera,
  bounds: THREE.Box3,
  direction: THREE.Vector3,
): number {
  const center = bounds.getCenter(new THREE.Vector3());
  const ahead = direction.clone().normalize().negate();
  const right = ahead.clone().cross(camera.up).normalize();
  const up = right.clone().cross(ahead);
  const high = Math.tan(THREE.MathUtils.degToRad(camera.fov) / 2);
  const wide = high * camera.aspect;
  let distance = 0;
  for (const corner of cornersOf(bounds)) {
    const at = corner.sub(center);
    const needed = Math.max(Math.abs(at.dot(right)) / wide, Math.abs(at.dot(up)) / high);
    distance = Math.max(distance, needed * MARGIN - at.dot(ahead));
  }
  return distance;
}

function cornersOf({ min, max }: THREE.Box3): THREE.Vector3[] {
  return [min.x, max.x].flatMap((x) =>
    [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new THREE.Vector3(x, y, z))),
  );
}

/** Returns the part of a large world that the first view shows: the surroundings of the robot. */
export function surroundingsOf(bounds: THREE.Box3, robot: THREE.Vector3, most: number): THREE.Box3 {
  if (bounds.isEmpty() || bounds.getSize(new THREE.Vector3()).length() <= most) return bounds.clone();
  const around = new THREE.Box3().setFromCenterAndSize(robot, new THREE.Vector3(1, 1, 1));
  return around.expandByScalar(most / 3).intersect(bounds);
}
