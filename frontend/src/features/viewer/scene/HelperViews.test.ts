import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Scene, SensorPlacement, Shape } from '@/generated/messages';
import { objectsOf, valuesOf } from '../../../../harness/scene';
import { FramesView, FrustumView, pyramidOf } from './HelperViews';
import { World } from './World';

const BOX: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const sensor = (kind: 'camera' | 'lidar', object_id = 2): SensorPlacement => ({
  name: kind,
  kind,
  object_id,
  pose: [0.1, 0.2, 0.3, 0, 0, Math.SQRT1_2, Math.SQRT1_2],
  fov: Math.PI / 2,
  range: 1,
});
const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'wall', link: '', kind: 'static', shapes: [BOX], pose: [5, 0, 0, 0, 0, 0, 1] },
    { id: 2, body: 'robot', link: 'base', kind: 'robot', shapes: [BOX], pose: [0, 0, 0, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [sensor('camera'), sensor('lidar'), sensor('camera', 99)],
};

const sizeOf = (axes: THREE.AxesHelper) => Math.max(...valuesOf(axes.geometry));

describe('pyramidOf', () => {
  it('is as wide as the field of view, and three quarters as high', () => {
    const values = valuesOf(pyramidOf({ fov: Math.PI / 2, range: 2 }));
    const corners = [
      [2, 2, 1.5],
      [2, -2, 1.5],
      [2, -2, -1.5],
      [2, 2, -1.5],
    ];
    const lines = corners.flatMap((corner, at) => [0, 0, 0, ...corner, ...corner, ...corners[(at + 1) % 4]!]);
    expect(values).toEqual(lines);
  });

  it.each([
    [40, 2.5],
    [0, 2.5],
    [1, 1],
  ])('of a range of %s m is %s m long', (range, length) => {
    expect(Math.max(...valuesOf(pyramidOf({ fov: 0.1, range })))).toBe(length);
  });
});

describe('coordinate frames', () => {
  it('are those of the world, of robots and, smaller, of their sensors', () => {
    const world = new World(SCENE, true);
    const view = new FramesView(SCENE, world);
    expect(sizeOf(view.origin)).toBe(0.6);
    expect(view.origin.position.z).toBe(0.005);
    const axes = objectsOf(world.group, THREE.AxesHelper);
    expect(axes.map(sizeOf)).toEqual([0.25, 0.15, 0.15]);
    expect(axes.every(({ parent }) => parent === world.object(2))).toBe(true);
    expect(axes[1]!.position.toArray()).toEqual([0.1, 0.2, 0.3]);
    expect(axes[1]!.rotation.z).toBeCloseTo(Math.PI / 2);
    expect((axes[0]!.material as THREE.Material).depthTest).toBe(false);
  });

  it('are shown, hidden, and removed', () => {
    const world = new World(SCENE, true);
    const view = new FramesView(SCENE, world);
    view.show(false);
    expect(objectsOf(world.group, THREE.AxesHelper).map(({ visible }) => visible)).toEqual([
      false,
      false,
      false,
    ]);
    expect(view.origin.visible).toBe(false);
    view.show(true);
    expect(view.origin.visible).toBe(true);
    view.dispose();
    expect(objectsOf(world.group, THREE.AxesHelper)).toEqual([]);
  });
});

describe('the fields of view of cameras', () => {
  it('are a pyramid from each lens', () => {
    const world = new World(SCENE, true);
    const view = new FrustumView(SCENE, world);
    const pyramids = objectsOf(world.group, THREE.LineSegments);
    expect(pyramids).toHaveLength(1);
    expect(pyramids[0]!.parent).toBe(world.object(2));
    expect(pyramids[0]!.position.toArray()).toEqual([0.1, 0.2, 0.3]);
    expect(pyramids[0]!.frustumCulled).toBe(false);
    view.show(false);
    expect(pyramids[0]!.visible).toBe(false);
    view.show(true);
    expect(pyramids[0]!.visible).toBe(true);
  });

  it('are removed and freed', () => {
    const world = new World(SCENE, true);
    const view = new FrustumView(SCENE, world);
    const [pyramid] = objectsOf(world.group, THREE.LineSegments);
    const freed = vi.fn();
    pyramid!.geometry.addEventListener('dispose', freed);
    (pyramid!.material as THREE.Material).addEventListener('dispose', freed);
    view.dispose();
    expect(freed).toHaveBeenCalledTimes(2);
    expect(pyramid!.parent).toBeNull();
  });
});
