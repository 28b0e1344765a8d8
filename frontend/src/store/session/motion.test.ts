import { describe, expect, it, vi } from 'vitest';
import type { Poses, Scene } from '@/generated/messages';
import { frames } from './frames';
import { speedOf, useMotion } from './motion';
import { currentPoses } from './poses';

const bytes = (array: Uint16Array) => new Uint8Array(array.buffer);

/** Returns a pose at x m, turned by 2 asin(0.6) about z, packed like `executor/stream/pose_codec.py` does. */
function packed(x: number): Uint8Array {
  const record = new DataView(new ArrayBuffer(16));
  const units = Math.round(x * 10_000);
  record.setUint16(0, units & 0xffff, true);
  record.setInt8(2, units >> 16);
  record.setUint8(9, 3);
  record.setInt16(14, Math.round(0.6 * 32767 * Math.SQRT2), true);
  return new Uint8Array(record.buffer);
}

const scene: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'wall', link: '', kind: 'static', shapes: [], pose: [5, 0, 0, 0, 0, 0, 1] },
    { id: 4, body: 'robot', link: 'base', kind: 'robot', shapes: [], pose: [0, 0, 0, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1],
  sensors: [],
};

const poses = (t: number, x: number): Poses => ({
  type: 'poses',
  t,
  ids: bytes(new Uint16Array([4])),
  poses: packed(x),
});

describe('speedOf', () => {
  it('is the path length over the time', () => {
    const samples = [0, 0.5, 1].map((t) => ({ t, x: 0.3 * t, y: 0 }));
    expect(speedOf(samples)).toBeCloseTo(0.3);
  });

  it('is zero while time does not pass', () => {
    expect(speedOf([{ t: 1, x: 0, y: 0 }])).toBe(0);
    expect(speedOf([])).toBe(0);
  });
});

describe('poses', () => {
  it('keep the poses of objects that later frames leave out', () => {
    frames.publish(scene);
    frames.publish(poses(0.1, 1));
    expect(currentPoses.get(1)?.[0]).toBe(5);
    expect(currentPoses.get(4)?.[0]).toBe(1);
  });

  it("measure the robot's speed", () => {
    frames.publish(scene);
    for (let step = 0; step <= 20; step += 1) frames.publish(poses(step * 0.1, step * 0.05));
    expect(useMotion.getState().speed).toBeCloseTo(0.5, 1);
  });

  it('mean by their absence that the robot does not move', () => {
    vi.useFakeTimers();
    frames.publish(scene);
    for (let step = 0; step <= 20; step += 1) frames.publish(poses(step * 0.1, step * 0.05));
    vi.advanceTimersByTime(1000);
    expect(useMotion.getState().speed).toBe(0);
    vi.useRealTimers();
  });

  it('are unpacked to a tenth of a millimetre, on either side of the origin', () => {
    frames.publish(scene);
    for (const x of [1.2345, -1.2345, -700, 0]) {
      frames.publish(poses(0.1, x));
      const pose = Array.from(currentPoses.get(4) ?? []);
      expect(pose[0]).toBeCloseTo(x, 3);
      expect(pose[5]).toBeCloseTo(0.6, 4);
      expect(pose[6]).toBeCloseTo(0.8, 4);
    }
  });

  it('are read even if the bytes do not start at a multiple of four', () => {
    frames.publish(scene);
    const frame = poses(0.1, 2);
    const shifted = new Uint8Array(frame.poses.length + 1);
    shifted.set(frame.poses, 1);
    frames.publish({ ...frame, poses: shifted.subarray(1) });
    expect(currentPoses.get(4)?.[0]).toBe(2);
  });
});
