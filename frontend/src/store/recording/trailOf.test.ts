import { expect, it } from 'vitest';
import { packPose, type PosesFrame } from './posesAt';
import { trailOf } from './trailOf';

function frame(t: number, x: number, y = 0, id = 7): PosesFrame {
  const poses = new Uint8Array(32);
  packPose([9, 9, 0, 0, 0, 0, 1], poses, 0);
  packPose([x, y, 0, 0, 0, 0, 1], poses, 16);
  return { t, ids: Uint16Array.from([1, id]), poses };
}
const rounded = (points: Float32Array) => Array.from(points, (value) => Math.round(value * 100) / 100);

it('is the path of one object, and leaves out where it stands', () => {
  const frames = [frame(0, 0), frame(0.1, 0.01), frame(0.2, 0.1), frame(0.3, 5, 5, 8), frame(0.4, 0.2)];
  expect(rounded(trailOf(frames, 7))).toEqual([0, 0, 0, 1, 0.1, 0, 0.2, 0, 0.2, 0, 0.4, 0]);
});

it('begins again where the object was put elsewhere', () => {
  const frames = [frame(0, 0), frame(0.1, 0.1), frame(0.2, 4)];
  expect(rounded(trailOf(frames, 7)).slice(8)).toEqual([4, 0, 0.2, 1]);
});

it('has fewer points of a long path, from its begin to its end', () => {
  const frames = Array.from({ length: 20_000 }, (_, at) => frame(at / 30, at * 0.04));
  const points = trailOf(frames, 7);
  expect(points.length / 4).toBeLessThan(6000);
  expect(points[2]).toBe(0);
  expect(points[points.length - 2]).toBeGreaterThan(19_000 / 30);
});
