import * as THREE from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Scene, SceneObject, Shape } from '@/generated/messages';
import { currentPoses } from '@/store/session/poses';
import { objectsOf } from '../../../../harness/scene';
import { World } from './World';

const BOX: Shape = { shape: 'box', size: [1, 2, 3], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const object = (id: number, body: string, more: Partial<SceneObject> = {}): SceneObject => ({
  id,
  body,
  link: '',
  kind: 'dynamic',
  shapes: [BOX],
  pose: [0, 0, 0, 0, 0, 0, 1],
  ...more,
});

const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    object(1, 'wall', { kind: 'static', pose: [5, 0, 0, 0, 0, 0, 1] }),
    object(2, 'robot', { kind: 'robot', link: 'base' }),
    object(3, 'robot', { kind: 'robot', link: 'arm', pose: [0, 0, 3, 0, 0, 0, 1] }),
    object(4, 'crate', { pose: [0, 4, 0, 0, 0, 0, 1] }),
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const pose = (x: number) => [x, 0, 0, 0, 0, 0, 1];
const xOf = (world: World, id: number) => world.object(id)!.position.x;

beforeEach(() => currentPoses.clear());

describe('the objects of a world', () => {
  it('are at the poses of the scene, named by body and link', () => {
    const world = new World(SCENE, true);
    expect(world.group.children.map(({ name }) => name)).toEqual([
      'wall',
      'robot/base',
      'robot/arm',
      'crate',
    ]);
    expect(world.object(1)?.position.toArray()).toEqual([5, 0, 0]);
    expect(world.object(9)).toBeUndefined();
    expect(world.bounds.max.toArray()).toEqual([5.5, 5, 4.5]);
    expect(world.bounds.min.x).toBe(-0.5);
  });

  it('are at their latest poses, not at those of the scene', () => {
    currentPoses.set(2, pose(3));
    expect(xOf(new World(SCENE, true), 2)).toBe(3);
  });

  it('include the first robot, which is the one to follow', () => {
    const world = new World(SCENE, true);
    expect([world.robotId, world.robot]).toEqual([2, world.object(2)]);
    const still = new World({ ...SCENE, objects: [SCENE.objects[0]!] }, true);
    expect([still.robotId, still.robot]).toEqual([null, null]);
  });

  it('leave out ceilings and the upper parts of walls', () => {
    const upper: Shape = { ...BOX, pose: [0, 0, 3, 0, 0, 0, 1], ceiling: true };
    const world = new World({ ...SCENE, objects: [object(1, 'wall', { shapes: [BOX, upper] })] }, true);
    expect(world.object(1)?.children).toHaveLength(1);
    expect(world.bounds.max.z).toBeCloseTo(1.5);
  });

  it('receive shadows where they are static', () => {
    const world = new World(SCENE, true);
    const receives = (id: number) => objectsOf(world.object(id)!, THREE.Mesh)[0]?.receiveShadow;
    expect([receives(1), receives(4)]).toEqual([true, false]);
  });

  it('have parts, and each part has its object', () => {
    const world = new World(SCENE, true);
    expect(world.objectsOf('robot')).toEqual([world.object(2), world.object(3)]);
    expect(world.objectsOf('gone')).toEqual([]);
    expect(world.idOf(world.object(4)!.children[0]!)).toBe(4);
    expect(world.idOf(world.group)).toBeNull();
  });

  it('have the size of all pieces of their body, and no more', () => {
    const world = new World(SCENE, true);
    world.object(2)!.add(new THREE.AxesHelper(50));
    const size = world.boundsOf('robot').getSize(new THREE.Vector3());
    expect(size.toArray()).toEqual([1, 2, 6]);
  });
});

describe('the motion of a world', () => {
  it('goes from one pose to the next within the time between two frames', () => {
    const world = new World(SCENE, true);
    world.receive([[2, pose(0.1)]], 1000);
    expect(world.advance(1025)).toBe(true);
    expect(xOf(world, 2)).toBeCloseTo(0.05);
    expect(world.advance(1050)).toBe(false);
    expect(xOf(world, 2)).toBeCloseTo(0.1);
    expect(world.advance(9000)).toBe(false);
  });

  it('also interpolates the rotation', () => {
    const world = new World(SCENE, true);
    world.receive([[2, [0, 0, 0, 0, 0, 1, 0]]], 1000);
    world.advance(1025);
    expect(new THREE.Euler().setFromQuaternion(world.object(2)!.quaternion).z).toBeCloseTo(Math.PI / 2);
  });

  it('follows the rate of frames', () => {
    const world = new World(SCENE, true);
    world.receive([], 1000);
    world.receive([[2, pose(0.1)]], 1150);
    // The interval is now 60 ms: a tenth of the way from 50 ms to 150 ms.
    expect(world.advance(1150 + 59)).toBe(true);
    expect(world.advance(1150 + 61)).toBe(false);
  });

  it.each([
    [9000, 50 + 15],
    [1001, 50 - 4],
  ])('does not use a frame at %s ms for its rate', (at, interval) => {
    const world = new World(SCENE, true);
    world.receive([], 1000);
    world.receive([[2, pose(0.1)]], at);
    expect(world.advance(at + interval - 1)).toBe(true);
    expect(world.advance(at + interval + 1)).toBe(false);
  });

  it('shows a jump of more than a metre at once', () => {
    const world = new World(SCENE, true);
    world.receive([[2, pose(1)]], 1000);
    expect(xOf(world, 2)).toBe(0);
    world.receive([[4, [4, 4, 0, 0, 0, 0, 1]]], 1000);
    expect(xOf(world, 4)).toBe(4);
    world.receive([[99, pose(1)]], 1000);
  });

  it('does not move a held body, until it is released', () => {
    const world = new World(SCENE, true);
    world.receive([[2, pose(0.5)]], 1000);
    world.hold('robot');
    expect(world.advance(1020)).toBe(false);
    world.receive([[2, pose(0.9)]], 1050);
    expect(world.advance(2000)).toBe(false);
    expect(xOf(world, 2)).toBe(0);
    world.letGo('robot');
    world.receive([[2, pose(0.9)]], 2050);
    world.advance(9000);
    expect(xOf(world, 2)).toBeCloseTo(0.9);
  });

  it('returns a body to its last received pose', () => {
    const world = new World(SCENE, true);
    currentPoses.set(2, pose(0.3));
    currentPoses.set(4, pose(7));
    world.put('robot');
    expect(xOf(world, 2)).toBeCloseTo(0.3);
    expect(world.object(3)?.position.z).toBe(3);
    expect(xOf(world, 4)).toBe(0);
  });

  it('frees what it drew', () => {
    const world = new World(SCENE, true);
    const freed = vi.fn();
    const [mesh] = objectsOf(world.group, THREE.Mesh);
    mesh!.geometry.addEventListener('dispose', freed);
    (mesh!.material as THREE.Material).addEventListener('dispose', freed);
    world.dispose();
    expect(freed).toHaveBeenCalledTimes(2);
  });
});
