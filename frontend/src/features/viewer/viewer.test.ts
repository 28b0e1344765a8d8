import * as THREE from 'three';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Scan, Scene, Shape } from '@/generated/messages';
import { currentPoses } from '@/store/session/poses';
import { LidarView } from './LidarView';
import { panned, poseOf, START, turned, zoomed } from './orbit';
import { TrailView } from './TrailView';
import { World } from './World';

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

  it('ignores poses of objects that it does not have', () => {
    const world = new World(scene, true);
    world.receive([[99, pose(1)]], 1000);
    expect(world.advance(1010)).toBe(false);
  });
});

describe('TrailView', () => {
  const count = (trail: TrailView) => trail.line.geometry.drawRange.count;

  it('grows as the robot goes, and not while it stands', () => {
    const trail = new TrailView();
    for (let step = 0; step < 10; step += 1) trail.add(new THREE.Vector3(step * 0.1, 0, 0), step);
    trail.add(new THREE.Vector3(0.9, 0, 0), 11);
    expect(count(trail)).toBe(10);
  });

  it('begins anew where the robot was put somewhere else', () => {
    const trail = new TrailView();
    for (let step = 0; step < 10; step += 1) trail.add(new THREE.Vector3(step * 0.1, 0, 0), step);
    trail.add(new THREE.Vector3(-4, 0, 0), 9.1);
    expect(count(trail)).toBe(1);
  });

  it('forgets the oldest half rather than grow without end', () => {
    const trail = new TrailView();
    for (let step = 0; step < 6010; step += 1) trail.add(new THREE.Vector3(step * 0.1, 0, 0), step);
    expect(count(trail)).toBe(3010);
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
