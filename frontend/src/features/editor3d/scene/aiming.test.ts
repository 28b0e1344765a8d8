import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { cameraAbove, pixelOf, testCanvas } from '../../../../harness/scene';
import { forwardOf, pointAt, thingAt } from './aiming';

function world() {
  const canvas = testCanvas();
  const camera = cameraAbove();
  const group = new THREE.Group();
  const keys = new Map<THREE.Object3D, string>();
  const add = (key: string | null, height: number, size: number, waypoint?: number) => {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(size, size, 0.1));
    mesh.position.set(1, 1, height);
    if (waypoint !== undefined) mesh.userData['waypoint'] = waypoint;
    if (key !== null) keys.set(mesh, key);
    group.add(mesh);
    return mesh;
  };
  const scene = { group, keyOf: (part: THREE.Object3D) => keys.get(part) ?? null };
  return {
    canvas,
    camera,
    add,
    hit: (x: number, y: number) => thingAt(pixelOf(camera, x, y, 2), canvas, camera, scene),
  };
}

describe('thingAt', () => {
  it('is the thing in front, with the height of the point', () => {
    const { add, hit } = world();
    add('low', 1, 2);
    add('high', 2, 1);
    expect(hit(1, 1)).toEqual({ key: 'high', height: expect.closeTo(2.05, 5) as number, waypoint: null });
    expect(hit(1.6, 1)?.key).toBe('low');
    expect(hit(-3, 0)).toBeNull();
  });

  it('is found where it is now, and by the camera where it is now, before the next picture', () => {
    const { add, hit, camera, canvas } = world();
    const moved = add('moved', 2, 1);
    expect(hit(1, 1)?.key).toBe('moved');
    moved.position.x = 3;
    expect(hit(1, 1)).toBeNull();
    expect(hit(3, 1)?.key).toBe('moved');
    const pixel = pixelOf(camera, 3, 1, 2);
    camera.position.x += 2;
    expect(pointAt(pixel, canvas, camera, 2)![0]).toBeCloseTo(5, 5);
  });

  it('prefers the handle of a waypoint to things that hide it', () => {
    const { add, hit } = world();
    add('handle', 0, 1, 3);
    add('box', 2, 1);
    expect(hit(1, 1)).toMatchObject({ key: 'handle', waypoint: 3 });
  });

  it('ignores invisible objects, and objects without a thing', () => {
    const { add, hit } = world();
    const hidden = add('hidden', 2, 1);
    hidden.visible = false;
    expect(hit(1, 1)).toBeNull();
    add(null, 1, 1);
    expect(hit(1, 1)).toBeNull();
  });
});

describe('pointAt', () => {
  it('is where the ray meets the floor, or a height above it', () => {
    const { canvas, camera } = world();
    const floor = pointAt(pixelOf(camera, 2, -3), canvas, camera)!;
    expect(floor[0]).toBeCloseTo(2);
    expect(floor[1]).toBeCloseTo(-3);
    const higher = pointAt(pixelOf(camera, 2, -3), canvas, camera, 5)!;
    expect(higher[0]).toBeCloseTo(1);
    expect(higher[1]).toBeCloseTo(-1.5);
  });

  it('is null if the camera looks up', () => {
    const { canvas, camera } = world();
    camera.lookAt(0, 0, 20);
    camera.updateMatrixWorld(true);
    expect(pointAt({ clientX: 200, clientY: 150 }, canvas, camera)).toBeNull();
  });

  it('counts from the corner of the canvas', () => {
    const { canvas, camera } = world();
    canvas.getBoundingClientRect = () => new DOMRect(50, 20, 400, 300);
    const point = pointAt({ clientX: 250, clientY: 170 }, canvas, camera)!;
    expect(point[0]).toBeCloseTo(0);
    expect(point[1]).toBeCloseTo(0);
  });
});

describe('forwardOf', () => {
  it.each([
    [
      [-5, 1, 3],
      [1, 0],
    ],
    [
      [5, 1, 3],
      [-1, 0],
    ],
    [
      [1, -5, 3],
      [0, 1],
    ],
    [
      [1, 5, 3],
      [0, -1],
    ],
  ] as const)('is the axis away from a camera at %o', (from, axis) => {
    const camera = cameraAbove();
    camera.up.set(0, 0, 1);
    camera.position.fromArray([...from]);
    camera.lookAt(0, 0, 0);
    camera.updateMatrixWorld(true);
    expect(forwardOf(camera)).toEqual(axis);
  });

  it('is up on the screen if the camera looks straight down', () => {
    const camera = cameraAbove();
    expect(forwardOf(camera)).toEqual([0, 1]);
    camera.rotation.z = -Math.PI / 2;
    camera.updateMatrixWorld(true);
    expect(forwardOf(camera)).toEqual([1, 0]);
  });
});
