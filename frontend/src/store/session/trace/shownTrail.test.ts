import { expect, it, vi } from 'vitest';
import { ShownTrail } from './shownTrail';
import { Trail } from './trail';

function walked(count: number): Trail {
  const trail = new Trail();
  for (let step = 0; step < count; step += 1) trail.add(step * 0.5, 0, step);
  return trail;
}

it('is the whole path of the present, and the page’s own one until a moment before the recorded one is read', () => {
  const shown = new ShownTrail(walked(5));
  expect(shown.shown()).toHaveLength(5);
  shown.show(2.5, null);
  expect(shown.shown().map(([, , t]) => t)).toEqual([0, 1, 2]);
});

it('is the recorded path until a moment, from where the robot was put last', () => {
  const shown = new ShownTrail(walked(5));
  const points = Float32Array.from([0, 0, 0, 1, 1, 0, 1, 0, 9, 9, 2, 1, 9, 8, 3, 0]);
  shown.show(1.5, points);
  expect(shown.shown()).toEqual([
    [0, 0, 0],
    [1, 0, 1],
  ]);
  shown.show(9, points);
  expect(shown.shown()).toEqual([
    [9, 9, 2],
    [9, 8, 3],
  ]);
});

it('knows the time of a place, the later of two, and of none that is hidden or far', () => {
  const shown = new ShownTrail(new Trail());
  const points = Float32Array.from([0, 0, 0, 1, 1, 0, 1, 0, 2, 0, 2, 0, 1, 0, 3, 0]);
  shown.show(9, points);
  expect(shown.timeNear(1.05, 0, 0.2)).toBe(3);
  expect(shown.timeNear(1.5, 0.5, 0.2)).toBeNull();
  shown.show(2, points);
  expect(shown.timeNear(1, 0, 0.2)).toBe(1);
});

it('tells of each change once, and draws the present again when the robot moves', () => {
  const live = walked(2);
  const shown = new ShownTrail(live);
  const changed = vi.fn();
  const stop = shown.subscribe(changed);
  shown.show(1, null);
  shown.show(1, null);
  expect(changed).toHaveBeenCalledTimes(1);
  const past = shown.version;
  live.add(5, 0, 9);
  expect(shown.version).toBe(past);
  shown.show(null, null);
  const present = shown.version;
  live.add(5.5, 0, 10);
  expect(shown.version).not.toBe(present);
  stop();
  shown.show(1, null);
  expect(changed).toHaveBeenCalledTimes(2);
});
