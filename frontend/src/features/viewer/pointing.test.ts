import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import type { Scene, Shape } from '@/generated/messages';
import { cameraAbove, pixelOf, testCanvas } from '../../../harness/scene';
import { pointedAt, pointedAtHeight } from './pointing';
import { World } from './scene/World';

const BOX: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 7, body: 'crate', link: '', kind: 'dynamic', shapes: [BOX], pose: [2, 1, 0.5, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

function begin() {
  const canvas = testCanvas();
  const camera = cameraAbove();
  const world = new World(SCENE, true);
  const event = (x: number, y: number, z = 0) => new PointerEvent('pointermove', pixelOf(camera, x, y, z));
  return { canvas, camera, world, event };
}

describe('pointedAt', () => {
  it('is a body, at its surface', () => {
    const { canvas, camera, world, event } = begin();
    const hit = pointedAt(event(2, 1, 1), canvas, camera, world)!;
    expect(hit.objectId).toBe(7);
    expect(hit.point.toArray()).toEqual([expect.closeTo(2, 4), expect.closeTo(1, 4), expect.closeTo(1, 4)]);
  });

  it('is the ground beside it', () => {
    const { canvas, camera, world, event } = begin();
    const hit = pointedAt(event(-3, 2), canvas, camera, world)!;
    expect(hit.objectId).toBeNull();
    expect(hit.point.toArray()).toEqual([expect.closeTo(-3), expect.closeTo(2), expect.closeTo(0)]);
  });

  it('ignores lines, which are no bodies', () => {
    const { canvas, camera, world, event } = begin();
    const points = [new THREE.Vector3(-5, 2, 1), new THREE.Vector3(5, 2, 1)];
    world.group.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(points)));
    expect(pointedAt(event(-3, 2, 1), canvas, camera, world)?.objectId).toBeNull();
  });

  it('is null in the sky', () => {
    const { canvas, camera, world } = begin();
    camera.lookAt(0, 0, 20);
    camera.updateMatrixWorld(true);
    const middle = new PointerEvent('pointermove', { clientX: 200, clientY: 150 });
    expect(pointedAt(middle, canvas, camera, world)).toBeNull();
  });
});

describe('pointedAtHeight', () => {
  it('is where the ray reaches that height, whatever is in front', () => {
    const { canvas, camera, event } = begin();
    const at = (height: number) => pointedAtHeight(event(2, 1), canvas, camera, height)!.toArray();
    expect(at(0)).toEqual([expect.closeTo(2), expect.closeTo(1), expect.closeTo(0)]);
    expect(at(5)).toEqual([expect.closeTo(1), expect.closeTo(0.5), expect.closeTo(5)]);
  });

  it('counts from the corner of the canvas', () => {
    const { canvas, camera } = begin();
    canvas.getBoundingClientRect = () => new DOMRect(30, 40, 400, 300);
    const middle = new PointerEvent('pointermove', { clientX: 230, clientY: 190 });
    const at = pointedAtHeight(middle, canvas, camera, 0)!;
    expect([at.x, at.y]).toEqual([expect.closeTo(0), expect.closeTo(0)]);
  });
});
