import { expect, it } from 'vitest';
import { profileRow, profileSum } from './profile';
import type { RecordedNode } from './types';

const tree = [{ uid: 1 }, { uid: 2 }] as RecordedNode[];
const row = (t: number, generation: number, self: number) =>
  profileRow(t, {
    generation,
    ticks: 10,
    uid: new Uint32Array([1, 2]),
    calls: new Uint32Array([10, 5]),
    total_ms: new Float32Array([8, self]),
    self_ms: new Float32Array([8 - self, self]),
  });

it('reads a message', () => {
  expect(row(0.5, 1, 2)).toEqual({
    t: 0.5,
    generation: 1,
    ticks: 10,
    nodes: [
      { uid: 1, calls: 10, total_ms: 8, self_ms: 6 },
      { uid: 2, calls: 5, total_ms: 2, self_ms: 2 },
    ],
  });
  expect(profileRow(1, {}).nodes).toEqual([]);
});

it('adds the messages that end in a part of the run, of its last tree', () => {
  const rows = [row(0.5, 1, 1), row(1, 2, 2), row(1.5, 2, 4), row(2, 2, 6)];
  const sum = profileSum(rows, 0.2, 1.5, (generation) => (generation === 2 ? tree : []));
  expect(sum).toEqual({
    ticks: 20,
    tick_ms: 16,
    nodes: [
      { uid: 1, calls: 20, total_ms: 16, self_ms: 10 },
      { uid: 2, calls: 10, total_ms: 6, self_ms: 6 },
    ],
    tree,
  });
});

it('is empty where nothing was measured', () => {
  expect(profileSum([row(0.5, 1, 1)], 1, 2, () => [])).toEqual({ ticks: 0, tick_ms: 0, nodes: [], tree: [] });
});
