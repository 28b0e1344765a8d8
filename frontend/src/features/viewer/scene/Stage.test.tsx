import { act } from '@testing-library/react';
import * as THREE from 'three';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Poses, Scan, Scene, Shape } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { hidePaths, showPaths } from '@/store/session/trace/shownPaths';
import { trail } from '@/store/session/trace/trail';
import { objectsOf, showScene } from '../../../../harness/scene';
import { pageHost } from '../pageHost';
import { loadViewOptions, type ViewOptions } from '../viewOptions';
import { Stage } from './Stage';

const BOX: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'wall', link: '', kind: 'static', shapes: [BOX], pose: [5, 0, 0, 0, 0, 0, 1] },
    { id: 2, body: 'robot', link: 'base', kind: 'robot', shapes: [BOX], pose: [0, 0, 0, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [{ direction: [0, 0, -1], intensity: 1 }],
  ground_color: [1, 1, 1, 1],
  sensors: [{ name: 'eye', kind: 'camera', object_id: 2, pose: [0, 0, 1, 0, 0, 0, 1], fov: 1, range: 2 }],
};
const SCAN: Scan = {
  type: 'scan',
  t: 1,
  sensor: 'scan',
  pose: [0, 0, 0.2, 0, 0, 0, 1],
  angle_min: 0,
  angle_increment: 1,
  range_max: 8,
  ranges: new Uint8Array(new Float32Array([1, 2]).buffer),
};

/** Returns a frame with the robot at x, packed as the session does. */
function robotAt(x: number, t: number): Poses {
  const poses = new DataView(new ArrayBuffer(16));
  const units = Math.round(x * 1e4);
  poses.setUint16(0, units & 0xffff, true);
  poses.setInt8(2, units >> 16);
  poses.setUint8(9, 3);
  return {
    type: 'poses',
    t,
    ids: new Uint8Array(new Uint16Array([2]).buffer),
    poses: new Uint8Array(poses.buffer),
  };
}

function stage(more: Partial<ViewOptions> = {}) {
  const onMoved = vi.fn();
  const onDrawn = vi.fn();
  const element = (options: ViewOptions) => (
    <Stage
      scene={SCENE}
      options={options}
      isDark={false}
      isJudged
      host={pageHost}
      onMoved={onMoved}
      onSlow={vi.fn()}
      onDrawn={onDrawn}
    />
  );
  let options = { ...loadViewOptions(), ...more };
  const shown = showScene(element(options));
  const change = (part: Partial<ViewOptions>) => shown.rerender(element((options = { ...options, ...part })));
  const robot = () => shown.scene.getObjectByName('robot/base')!;
  return { ...shown, change, robot, onDrawn };
}

beforeEach(() => {
  localStorage.clear();
  act(() => frames.publish(SCENE));
  onTestFinished(() => {
    frames.clear();
    trail.clear();
  });
});

describe('the stage of a world', () => {
  it('draws the world from the side', () => {
    const { scene, camera, robot } = stage();
    expect(scene.getObjectByName('wall')?.position.x).toBe(5);
    expect(robot().position.x).toBe(0);
    expect(camera.position.x).toBeLessThan(0);
    expect(camera.position.z).toBeGreaterThan(2);
  });

  it('reports its first picture', async () => {
    const { draw, onDrawn } = stage();
    draw();
    await vi.waitFor(() => expect(onDrawn).toHaveBeenCalledOnce());
  });

  it('moves the robot by its poses, frame by frame', () => {
    const { draw, robot } = stage();
    const now = vi.spyOn(performance, 'now').mockReturnValue(1000);
    act(() => frames.publish(robotAt(0.1, 1)));
    now.mockReturnValue(1025);
    draw();
    expect(robot().position.x).toBeCloseTo(0.05, 3);
    now.mockReturnValue(2000);
    draw();
    expect(robot().position.x).toBeCloseTo(0.1, 3);
  });

  it('follows the robot smoothly if that is switched on', () => {
    let now = performance.now();
    const clock = vi.spyOn(performance, 'now').mockImplementation(() => now);
    onTestFinished(() => clock.mockRestore());
    const { draw, camera, change } = stage();
    const start = camera.position.x;
    const pass = () => {
      now += 100;
      draw();
    };
    const robotGoes = (x: number) => {
      act(() => frames.publish(robotAt(x, x)));
      pass();
      pass();
    };
    robotGoes(0.5);
    const first = camera.position.x - start;
    expect(first).toBeGreaterThan(0);
    expect(first).toBeLessThan(0.5);
    for (let count = 0; count < 60; count += 1) pass();
    expect(camera.position.x - start).toBeCloseTo(0.5, 1);
    change({ follow: false });
    robotGoes(0.9);
    expect(camera.position.x - start).toBeCloseTo(0.5, 1);
  });

  it("shows rays, trail, frames, cameras' fields of view and the grid as chosen", () => {
    const { scene, change, draw } = stage({ frames: true });
    act(() => frames.publish(SCAN));
    for (let step = 0; step < 4; step += 1) act(() => frames.publish(robotAt(step * 0.1, step)));
    draw();
    const shown = () => ({
      rays: objectsOf(scene, THREE.Points).length > 0,
      trail: objectsOf(scene, LineSegments2).filter(({ visible }) => visible).length,
      frames: objectsOf(scene, THREE.AxesHelper).filter(({ visible }) => visible).length,
      frustum: objectsOf(scene.getObjectByName('robot/base')!, THREE.LineSegments).filter(
        (lines) => lines.visible && !(lines instanceof THREE.AxesHelper),
      ).length,
      grid: objectsOf(scene, THREE.GridHelper).length,
    });
    expect(shown()).toEqual({ rays: true, trail: 1, frames: 3, frustum: 1, grid: 1 });
    change({ rays: false, trail: false, frames: false, frustum: false, grid: false });
    expect(shown()).toEqual({ rays: false, trail: 0, frames: 0, frustum: 0, grid: 0 });
  });

  it('draws paths beside the trail, as long as they are shown', () => {
    const { scene } = stage({ trail: false });
    const lines = [Float32Array.of(0, 0, 1, 1, 1, 0, 2, 0)];
    const path = { label: '1', name: 'wider', hue: 215, isDashed: false, labelAt: 'end', lines } as const;
    act(() => showPaths('compare', [path, { ...path, label: '2' }]));
    expect(objectsOf(scene, LineSegments2)).toHaveLength(2);
    act(() => hidePaths('compare'));
    expect(objectsOf(scene, LineSegments2)).toHaveLength(0);
  });

  it('draws the last scan at the sensor', () => {
    const { scene } = stage();
    act(() => frames.publish(SCAN));
    const [hits] = objectsOf(scene, THREE.Points);
    expect(hits!.geometry.drawRange.count).toBe(2);
    expect(hits!.parent?.position.z).toBe(0.2);
  });

  it('moves the camera above on request', () => {
    const { camera, change } = stage();
    change({ viewpoint: { kind: 'top' } });
    // The camera is in the middle between wall and robot.
    expect(camera.position.x).toBeCloseTo(2.5, 1);
    expect(camera.position.y).toBeCloseTo(0, 1);
  });

  it('draws another frame for each message', async () => {
    const { frames: count } = stage();
    await vi.waitFor(() => expect(count()).toBeGreaterThan(0));
    let before = count();
    act(() => frames.publish(robotAt(0.1, 1)));
    await vi.waitFor(() => expect(count()).toBeGreaterThan(before));
    before = count();
    act(() => frames.publish(SCAN));
    await vi.waitFor(() => expect(count()).toBeGreaterThan(before));
  });

  it('receives nothing after its end', () => {
    const { rerender, robot, scene } = stage();
    const kept = robot();
    rerender(<group />);
    act(() => frames.publish(robotAt(4, 1)));
    expect(kept.position.x).toBe(0);
    expect(scene.getObjectByName('wall')).toBeUndefined();
  });
});
