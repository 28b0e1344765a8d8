import { expect, it } from 'vitest';
import { moved, packPose, posesAt, unpackPose, type Pose, type PosesFrame } from './posesAt';
import type { PosesAt } from './types';

const pose = (x: number, yaw = 0): Pose => [x, 0, 0.1, 0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)];

function frame(t: number, poses: Readonly<Record<number, Pose>>): PosesFrame {
  const ids = Uint16Array.from(Object.keys(poses), Number);
  const packed = new Uint8Array(ids.length * 16);
  Object.values(poses).forEach((each, index) => packPose(each, packed, index * 16));
  return { t, ids, poses: packed };
}

function shown(frames: readonly PosesFrame[], t: number): Record<number, Pose> {
  const found = posesAt(frames, t)!;
  const ids = new Uint16Array(found.ids.slice().buffer);
  return Object.fromEntries([...ids].map((id, index) => [id, unpackPose(found.poses, index * 16)]));
}

it('packs a pose as the stream does', () => {
  const packed = new Uint8Array(16);
  const turned: Pose = [-1.2345, 2.5, -0.0001, 0.5, -0.5, 0.5, -0.5];
  packPose(turned, packed, 0);
  unpackPose(packed, 0).forEach((value, part) =>
    expect(Math.abs(value)).toBeCloseTo(Math.abs(turned[part]!), 4),
  );
});

it('moves objects evenly between two frames, and keeps those that stand', () => {
  const frames = [
    frame(0, { 1: pose(0), 2: pose(5) }),
    frame(1, { 1: pose(1) }),
    frame(1.1, { 1: pose(1.2, 0.4) }),
  ];
  expect(shown(frames, 1.05)[1]![0]).toBeCloseTo(1.1, 3);
  expect(shown(frames, 1.05)[1]![5]).toBeCloseTo(Math.sin(0.1), 3);
  expect(shown(frames, 1.05)[2]![0]).toBeCloseTo(5, 3);
});

it('does not slide an object that paused for long or was put elsewhere', () => {
  const frames = [frame(0, { 1: pose(0) }), frame(1, { 1: pose(0.1) }), frame(1.1, { 1: pose(8) })];
  expect(shown(frames, 0.9)[1]![0]).toBeCloseTo(0, 3);
  expect(shown(frames, 1.05)[1]![0]).toBeCloseTo(0.1, 3);
});

it('says which bodies moved, and how far; rounding is no motion', () => {
  const at = (x: number, turn: number): PosesAt => {
    const poses = new Uint8Array(32);
    packPose([x, 0, 0, 0, 0, Math.sin(turn / 2), Math.cos(turn / 2)], poses, 0);
    packPose([5, 0, 0, 0, 0, 0, 1], poses, 16);
    return { ids: new Uint8Array(Uint16Array.from([3, 4]).buffer), poses };
  };
  const [found, ...others] = moved(at(1, 0), at(1.5, Math.PI / 2));
  expect(others).toEqual([]);
  expect(found?.id).toBe(3);
  expect(found?.metres).toBeCloseTo(0.5);
  expect(found?.degrees).toBeCloseTo(90, 0);
  expect(moved(at(1, 0), at(1.0005, 0))).toEqual([]);
  expect(moved(null, at(1, 0))).toEqual([]);
});
