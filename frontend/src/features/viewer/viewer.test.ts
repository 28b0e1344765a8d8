import * as THREE from 'three';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Scan, Scene, Shape } from '@/generated/messages';
import { currentPoses } from '@/store/session/poses';
import { Trail } from '@/store/session/trace/trail';
import { DraggedBody, carriable } from './scene/DraggedBody';
import { pyramidOf } from './scene/HelperViews';
import { LidarView } from './scene/LidarView';
import { addMeasured, distances, setMeasuring, useMeasuring } from './measuring';
import { panned, poseOf, START, turned, zoomed } from './orbit';
import { directionOf } from './TeleopPad';
import { TrailView } from './scene/TrailView';
import { World } from './scene/World';

const box: Shape = { shape: 'box', size: [1, 2, 3], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };

const scene: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'wall', link: '', kind: 'static', shapes: [box], pose: [5, 0, 0, 0, 0, 0, 1] },
    { id: 2, body: 'robot', link: 'base', kind: 'robot', shapes: [box], pose: [0, 0, 0, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const pose = (x: number) => [x, 0, 0, 0, 0, 0, 1];

beforeEach(() => currentPoses.clear());

describe('World', () => {
  it('moves objects between two frames, and arrives', () => {
    const world = new World(scene, true);
    world.receive([[2, pose(0.1)]], 1000);
    world.receive([[2, pose(0.2)]], 1100);
    expect(world.advance(1120)).toBe(true);
    expect(world.robot?.position.x).toBeGreaterThan(0);
    expect(world.robot?.position.x).toBeLessThan(0.2);
    expect(world.advance(2000)).toBe(false);
    expect(world.robot?.position.x).toBeCloseTo(0.2);
  });

  it('shows a reset at once', () => {
    const world = new World(scene, true);
    world.receive([[2, pose(4)]], 1000);
    expect(world.robot?.position.x).toBe(4);
  });

  it('begins where objects are, not where they were when the scene was made', () => {
    currentPoses.set(2, pose(3));
    expect(new World(scene, true).robot?.position.x).toBe(3);
  });

  it('leaves ceilings and the upper parts of walls out', () => {
    const upper: Shape = { ...box, pose: [0, 0, 3, 0, 0, 0, 1], ceiling: true };
    const wall = { ...scene.objects[0]!, shapes: [box, upper] };
    const world = new World({ ...scene, objects: [wall] }, true);
    expect(world.object(1)?.children).toHaveLength(1);
    expect(world.bounds.max.z).toBeCloseTo(1.5);
  });

  it('ignores poses of objects that it does not have', () => {
    const world = new World(scene, true);
    world.receive([[99, pose(1)]], 1000);
    expect(world.advance(1010)).toBe(false);
  });
});

describe('TrailView', () => {
  it('shows what the trail has become, and nothing before there is a way', () => {
    const trail = new Trail();
    const view = new TrailView(trail);
    expect(view.line.visible).toBe(false);
    for (let step = 0; step < 10; step += 1) trail.add(step * 0.1, 0, step);
    expect(view.update()).toBe(true);
    expect(view.update()).toBe(false);
    expect(view.line.geometry.instanceCount).toBe(9);
  });
});

describe('DraggedBody', () => {
  const dragged = () => {
    const world = new World(scene, true);
    return { world, body: new DraggedBody(world, 'robot') };
  };

  it('takes a body along and turns it about itself; what it was stays known', () => {
    const { world, body } = dragged();
    body.moveBy(1, 2);
    body.turnBy(Math.PI / 2);
    expect(body.pose().slice(0, 3)).toEqual([1, 2, 0]);
    expect(body.pose()[5]).toBeCloseTo(Math.PI / 2);
    expect(body.origin.slice(0, 2)).toEqual([0, 0]);
    world.receive([[2, pose(9)]], 1000);
    world.advance(5000);
    expect(world.robot!.position.x).toBeCloseTo(1);
    body.release(false);
    expect(world.robot!.position.x).toBeCloseTo(0);
  });

  it('cannot take the room', () => {
    const wall: Shape = { ...box, size: [10, 0.2, 1] };
    const room = { ...scene, objects: [{ ...scene.objects[0]!, shapes: [wall] }, scene.objects[1]!] };
    const world = new World(room, true);
    expect(carriable(world, 1)).toBeNull();
    expect(carriable(world, 2)).toBe('robot');
    expect(carriable(world, null)).toBeNull();
  });

  it('are as large as what they are made of, not as what their cameras see', () => {
    const world = new World(scene, true);
    const sight = new THREE.LineSegments(pyramidOf({ fov: 1, range: 40 }));
    world.object(2)?.add(sight);
    expect(new THREE.Box3().setFromObject(sight).getSize(new THREE.Vector3()).length()).toBeGreaterThan(3);
    expect(carriable(world, 2)).toBe('robot');
  });
});

describe('measuring', () => {
  it('measures between two points, and restarts with a third', () => {
    setMeasuring(true);
    addMeasured([0, 0, 0]);
    addMeasured([3, 4, 12]);
    const [a, b] = useMeasuring.getState().points;
    expect(distances([a!, b!])).toEqual({ straight: 13, flat: 5, rise: 12 });
    addMeasured([1, 1, 0]);
    expect(useMeasuring.getState().points).toEqual([[1, 1, 0]]);
  });
});

describe('driving by hand', () => {
  it('adds up what is held', () => {
    expect(directionOf(['KeyW', 'KeyA'])).toEqual({ linear: 1, angular: 1 });
    expect(directionOf(['ArrowUp', 'KeyW'])).toEqual({ linear: 1, angular: 0 });
    expect(directionOf(['KeyW', 'KeyS'])).toEqual({ linear: 0, angular: 0 });
    expect(directionOf([])).toEqual({ linear: 0, angular: 0 });
  });
});

describe('pyramidOf', () => {
  it('is as wide as the camera sees', () => {
    const corners = pyramidOf({ fov: Math.PI / 2, range: 2 }).getAttribute('position');
    expect(corners.getX(1)).toBe(2);
    expect(corners.getY(1)).toBeCloseTo(2);
  });
});

describe('LidarView', () => {
  it('draws a dot where a ray hit, and none where it did not', () => {
    const lidar = new LidarView();
    const ranges = new Float32Array([1, Infinity, 8, 2]);
    const scan: Scan = {
      type: 'scan',
      t: 0,
      sensor: 'scan',
      pose: pose(0),
      angle_min: 0,
      angle_increment: Math.PI / 2,
      range_max: 8,
      ranges: new Uint8Array(ranges.buffer),
    };
    lidar.show(scan);
    const [rays, hits] = lidar.group.children as [THREE.LineSegments, THREE.Points];
    expect(rays.geometry.drawRange.count).toBe(8);
    expect(hits.geometry.drawRange.count).toBe(2);
  });
});

describe('orbit', () => {
  const distance = ({ eye, target }: ReturnType<typeof poseOf>) =>
    Math.hypot(...eye.map((value, index) => value - (target[index] ?? 0)));

  it('keeps its distance while it turns, and stays above the ground', () => {
    const moved = turned(START, 500, 5000);
    expect(distance(poseOf(moved))).toBeCloseTo(START.distance);
    expect(poseOf(turned(START, 0, -5000)).eye[2]).toBeGreaterThan(0);
  });

  it('zooms within limits', () => {
    expect(zoomed(START, 0.0001).distance).toBe(0.5);
    expect(zoomed(START, 1e6).distance).toBe(60);
  });

  it('pans over the ground without changing the height', () => {
    expect(panned(START, 30, 10).target[2]).toBe(START.target[2]);
    expect(panned(START, 30, 10).target).not.toEqual(START.target);
  });
});
