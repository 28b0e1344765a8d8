import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { framingDistance, surroundingsOf } from './framing';

const room = new THREE.Box3(new THREE.Vector3(-5, -5, 0), new THREE.Vector3(5, 5, 1));
const SIDE = new THREE.Vector3(-0.62, -0.42, 0.58);

function cameraOf(aspect: number): THREE.PerspectiveCamera {
  const camera = new THREE.PerspectiveCamera(45, aspect);
  camera.up.set(0, 0, 1);
  return camera;
}

/** Returns whether the camera sees all corners of the room from a distance in m. */
function seesAll(camera: THREE.PerspectiveCamera, distance: number): boolean {
  const center = room.getCenter(new THREE.Vector3());
  camera.position.copy(SIDE).setLength(distance).add(center);
  camera.lookAt(center);
  camera.updateMatrixWorld(true);
  return [-5, 5].every((x) =>
    [-5, 5].every((y) =>
      [0, 1].every((z) => {
        const shown = new THREE.Vector3(x, y, z).project(camera);
        return Math.abs(shown.x) <= 1 && Math.abs(shown.y) <= 1;
      }),
    ),
  );
}

describe('the first view', () => {
  it.each([0.5, 1.4, 3])('shows the whole room with a small margin, at the aspect %s', (aspect) => {
    const camera = cameraOf(aspect);
    const distance = framingDistance(camera, room, SIDE);
    expect(seesAll(camera, distance)).toBe(true);
    expect(seesAll(camera, distance * 0.88)).toBe(false);
  });

  it('shows the surroundings of the robot in a large world', () => {
    const hall = new THREE.Box3(new THREE.Vector3(-50, -50, 0), new THREE.Vector3(50, 50, 3));
    const shown = surroundingsOf(hall, new THREE.Vector3(45, 0, 0), 24);
    expect(shown.containsPoint(new THREE.Vector3(45, 0, 0))).toBe(true);
    expect(shown.getSize(new THREE.Vector3()).length()).toBeLessThan(27);
    expect(surroundingsOf(room, new THREE.Vector3(), 24)).toEqual(room);
  });
});
