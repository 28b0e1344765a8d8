import { expect, it } from 'vitest';
import type { NodeTime, TreeNode } from '@/generated/messages';
import { flames, shareOf, slowest } from './profile';

const node = (uid: number, parent: number): TreeNode => ({
  uid,
  parent,
  type: 'Act',
  kind: 'Action',
  name: `n${uid}`,
  path: `n${uid}`,
  node_id: `b${uid}`,
  tree_id: 'Main',
});
const time = (uid: number, total_ms: number, self_ms: number): NodeTime => ({
  uid,
  calls: 1,
  total_ms,
  self_ms,
});
const TREE = [node(1, 0), node(2, 1), node(3, 2), node(4, 1)];

it('puts the slowest node first, and equal ones in the order of the tree', () => {
  expect(slowest([time(3, 1, 1), time(1, 9, 2), time(2, 1, 1)]).map(({ uid }) => uid)).toEqual([1, 2, 3]);
});

it('tells the share of a node, also of nothing', () => {
  expect(shareOf(time(1, 5, 2), 8)).toBe(0.25);
  expect(shareOf(time(1, 5, 2), 0)).toBe(0);
  expect(shareOf(time(1, 5, 20), 8)).toBe(1);
});

it('stacks nodes below their parents, side by side in the order of execution', () => {
  const found = flames(TREE, [time(1, 10, 1), time(2, 6, 2), time(3, 4, 4), time(4, 3, 3)]);
  expect(found.map(({ node: { uid }, from, width, depth }) => [uid, from, width, depth])).toEqual([
    [1, 0, 1, 0],
    [2, 0, 0.6, 1],
    [3, 0, 0.4, 2],
    [4, 0.6, 0.3, 1],
  ]);
});

it('leaves out nodes that were not ticked, what is below them, and what cannot be seen', () => {
  expect(flames(TREE, [time(1, 10, 1), time(3, 4, 4), time(4, 0.001, 0.001)])).toHaveLength(1);
  expect(flames(TREE, [])).toEqual([]);
  expect(flames([], [time(1, 1, 1)])).toEqual([]);
});

it('keeps children within their parent when rounding makes them wider', () => {
  const found = flames(TREE, [time(1, 10, 0), time(2, 7, 7), time(4, 4, 4)]);
  expect(found[2]!.from + found[2]!.width).toBeCloseTo(1);
});
