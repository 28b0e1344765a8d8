import * as THREE from 'three';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Scene, Shape } from '@/generated/messages';
import { currentPoses } from '@/store/session/poses';
import { objectsOf } from '../../../../harness/scene';
import { carriable, DraggedBody, poseOf } from './DraggedBody';
import { pyramidOf } from './HelperViews';
import { World } from './World';

const box = (...size: number[]): Shape => ({
  shape: 'box',
  size,
  pose: [0, 0, 0, 0, 0, 0, 1],
  color: [1, 0, 0, 1],
});
const HALF = Math.SQRT1_2;

const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'wall', link: '', kind: 'static', shapes: [box(10, 0.2, 1)], pose: [5, 0, 0, 0, 0, 0, 1] },
    {
      id: 2,
      body: 'robot',
      link: 'base',
      kind: 'robot',
      shapes: [box(1, 1, 1)],
      pose: [1, 2, 0, 0, 0, HALF, HALF],
    },
    { id: 3, body: 'robot', link: 'arm', kind: 'robot', shapes: [box(1, 1, 1)], pose: [2, 2, 1, 0, 0, 0, 1] },
    { id: 4, body: 'person', link: '', kind: 'actor', shapes: [box(1, 1, 1)], pose: [0, 5, 0, 0, 0, 0, 1] },
    { id: 5, body: 'tower', link: '', kind: 'dynamic', shapes: [box(3, 3, 9)], pose: [0, 9, 0, 0, 0, 0, 1] },
    {
      id: 6,
      body: 'carpet',
      link: '',
      kind: 'dynamic',
      shapes: [box(1, 3.1, 0.1)],
      pose: [9, 9, 0, 0, 0, 0, 1],
    },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const near = (numbers: readonly number[]) => numbers.map((part) => expect.closeTo(part, 6) as number);

function dragged() {
  const world = new World(SCENE, true);
  return { world, body: new DraggedBody(world, 'robot') };
}

beforeEach(() => currentPoses.clear());

describe('what can be dragged', () => {
  it.each([
    [2, 'robot'],
    [3, 'robot'],
    [5, 'tower'],
    [1, null],
    [4, null],
    [6, null],
    [99, null],
    [null, null],
  ])('the object %s: %s', (id, body) => {
    expect(carriable(new World(SCENE, true), id)).toBe(body);
  });

  it("has the size of its own shapes, without its cameras' frustums", () => {
    const world = new World(SCENE, true);
    const sight = new THREE.LineSegments(pyramidOf({ fov: 2.8, range: 40 }));
    expect(new THREE.Box3().setFromObject(sight).getSize(new THREE.Vector3()).length()).toBeGreaterThan(3);
    world.object(2)?.add(sight);
    expect(carriable(world, 2)).toBe('robot');
  });
});

describe('poseOf', () => {
  it('is a position, and angles about fixed axes', () => {
    const object = new THREE.Object3D();
    object.position.set(1, 2, 3);
    object.quaternion.setFromEuler(new THREE.Euler(0.1, 0.2, 0.3, 'ZYX'));
    expect(poseOf(object)).toEqual(near([1, 2, 3, 0.1, 0.2, 0.3]));
  });
});

describe('a dragged body', () => {
  it('must exist', () => {
    expect(() => new DraggedBody(new World(SCENE, true), 'gone')).toThrow('there is no body gone');
  });

  it('moves with all its parts, and turns about its base', () => {
    const { world, body } = dragged();
    expect(body.origin).toEqual(near([1, 2, 0, 0, 0, Math.PI / 2]));
    body.moveBy(3, -1);
    expect(body.pose()).toEqual(near([4, 1, 0, 0, 0, Math.PI / 2]));
    expect(world.object(3)!.position.toArray()).toEqual(near([5, 1, 1]));
    body.turnBy(-Math.PI / 4);
    body.turnBy(-Math.PI / 4);
    expect(body.pose()).toEqual(near([4, 1, 0, 0, 0, 0]));
    expect(world.object(3)!.position.toArray()).toEqual(near([4, 0, 1]));
    expect(body.origin).toEqual(near([1, 2, 0, 0, 0, Math.PI / 2]));
  });

  it('tells whether it has moved or turned by more than a tremble', () => {
    const { body } = dragged();
    expect(body.hasMoved).toBe(false);
    body.moveBy(0.004, 0);
    body.turnBy(0.004);
    expect(body.hasMoved).toBe(false);
    body.turnBy(-0.01);
    expect(body.hasMoved).toBe(true);
    body.turnBy(0.006);
    body.moveBy(0, 0.006);
    expect(body.hasMoved).toBe(true);
  });

  it('leaves a ghost at its old place while it is dragged', () => {
    const { world, body } = dragged();
    const ghost = world.group.children.at(-1)!;
    expect(ghost.children).toHaveLength(2);
    body.moveBy(3, 0);
    expect(ghost.children[0]!.position.toArray()).toEqual(near([1, 2, 0]));
    for (const mesh of objectsOf(ghost, THREE.Mesh))
      expect((mesh.material as THREE.MeshBasicMaterial).opacity).toBe(0.35);
    for (const mesh of objectsOf(world.object(2)!, THREE.Mesh))
      expect((mesh.material as THREE.Material).transparent).toBe(false);
    body.release(true);
    expect(ghost.parent).toBeNull();
  });

  it("ignores the session's poses meanwhile", () => {
    const { world, body } = dragged();
    body.moveBy(1, 0);
    world.receive([[2, [9, 9, 0, 0, 0, 0, 1]]], 1000);
    expect(body.pose()[0]).toBeCloseTo(2);
    body.release(true);
    expect(body.pose()[0]).toBeCloseTo(2);
    world.receive([[2, [9, 9, 0, 0, 0, 0, 1]]], 1050);
    expect(body.pose()[0]).toBeCloseTo(9);
  });

  it('returns if it is not kept', () => {
    const { world, body } = dragged();
    body.moveBy(1, 1);
    body.turnBy(1);
    body.release(false);
    expect(body.pose()).toEqual(near([1, 2, 0, 0, 0, Math.PI / 2]));
    expect(world.object(3)!.position.toArray()).toEqual(near([2, 2, 1]));
  });
});
