import { afterEach, expect, it, vi } from 'vitest';
import type { Poses, Scan, Scene } from '@/generated/messages';
import { packPose } from '@/store/recording/posesAt';
import type { Moment } from '@/store/recording/types';
import { frames, shownFrames } from '@/store/session/frames';
import { forEachPose } from '@/store/session/poses';
import { cameraFrame, composed, hasPicture, scanFrame, showPresentWorld, showWorld } from './world';

const object = (id: number) => ({
  id,
  body: 'r',
  link: '',
  kind: 'robot' as const,
  shapes: [],
  pose: [0, 0, 0, 0, 0, 0, 1],
});
const sensor = (name: string, kind: 'lidar' | 'camera') => ({
  name,
  kind,
  object_id: 1,
  pose: [0.1, 0, 0.2, 0, 0, 0, 1],
  fov: 1,
  range: 5,
});
const scene: Scene = {
  type: 'scene',
  name: 'w',
  t: 0,
  objects: [object(1)],
  meshes: {},
  lights: [],
  ground_color: [],
  sensors: [sensor('lidar', 'lidar'), sensor('camera', 'camera')],
};

function poses(t: number, x: number): Poses {
  const packed = new Uint8Array(16);
  packPose([x, 0, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2], packed, 0);
  return { type: 'poses', t, ids: new Uint8Array([1, 0]), poses: packed };
}

const scan = {
  t: 1,
  sensor: 'lidar',
  angleMin: 0,
  angleIncrement: 0.1,
  rangeMax: 5,
  ranges: new Float32Array([1, 2]),
};
const moment = (t: number, x: number): Moment => ({
  t,
  tick: 1,
  tickT: t,
  durationMs: null,
  generation: 1,
  tree: null,
  files: null,
  statuses: [],
  flashes: [],
  forced: [],
  was: [],
  halted: null,
  entries: [],
  scene: null,
  sceneId: -1,
  poses: poses(t, x),
  scan,
  pictures: [{ t, topic: '/world/camera/camera/compressed', jpeg: new Uint8Array([1]) }],
});

afterEach(() => {
  showPresentWorld();
  frames.clear();
});

const xOf = (frame: Poses) => {
  let x = NaN;
  forEachPose(frame, (_, pose) => (x = pose[0] ?? NaN));
  return x;
};

it('shows the recorded world in place of the present one, and the present one again', () => {
  const heard = vi.fn();
  frames.publish(scene);
  const stop = shownFrames.listen('poses', (frame) => heard(Math.round(xOf(frame) * 100) / 100));
  frames.publish(poses(5, 5));
  showWorld(moment(1, 1));
  frames.publish(poses(6, 6));
  showPresentWorld();
  expect(heard.mock.calls).toEqual([[5], [1], [6]]);
  stop();
});

it('shows the world of another run, in one that has none and in place of the present one', () => {
  const heard = vi.fn();
  const stop = shownFrames.listen('scene', ({ name }) => heard(name));
  const other = { ...scene, name: 'other' };
  showWorld(moment(1, 1), other);
  showWorld(moment(2, 1), other);
  expect(shownFrames.scene()).toBe(other);
  frames.publish(scene);
  expect(heard.mock.calls).toEqual([['other']]);
  showPresentWorld();
  expect(heard.mock.calls).toEqual([['other'], ['w']]);
  expect(shownFrames.scene()).toBe(scene);
  stop();
});

it('gives a view that opens meanwhile the recorded world', () => {
  frames.publish(scene);
  showWorld(moment(1, 1));
  const heard = vi.fn();
  shownFrames.listen('scan', (frame: Scan) => heard(frame.t, frame.ranges.length))();
  expect(heard.mock.calls).toEqual([[1, 8]]);
});

it('places a scan by the pose that its sensor had then', () => {
  const { pose } = scanFrame(scan, scene, poses(1, 2))!;
  expect(pose.slice(0, 3).map((value) => Math.round(value * 1000) / 1000)).toEqual([2, 0.1, 0.2]);
  expect(composed([0, 0, 0, 0, 0, 0, 1], pose)).toEqual(pose);
  expect(scanFrame(scan, scene, null)).toBeNull();
});

it('finds the camera of a topic', () => {
  const of = (topic: string) => cameraFrame({ t: 1, topic, jpeg: new Uint8Array() }, scene).sensor;
  expect(of('/world/camera/camera/compressed')).toBe('camera');
  expect(of('/camera/image_raw/compressed')).toBe('camera');
  frames.publish(scene);
  expect(hasPicture(moment(1, 1), 'camera')).toBe(true);
  expect(hasPicture(moment(1, 1), 'other')).toBe(false);
  expect(hasPicture({ ...moment(1, 1), pictures: [] }, null)).toBe(false);
});
