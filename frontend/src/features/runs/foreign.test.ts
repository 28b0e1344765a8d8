import { expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { depthsOf, isForeign } from './foreign';

const node = (uid: number, parent: number, node_id = '') => ({ uid, parent, node_id }) as TreeNode;

it('a tree without blocks of diagrams is foreign', () => {
  expect(isForeign([])).toBe(false);
  expect(isForeign([node(1, 0), node(2, 1)])).toBe(true);
  expect(isForeign([node(1, 0), node(2, 1, 'n2')])).toBe(false);
});

it('depths follow the parents; of a lost parent the node is a root', () => {
  expect(depthsOf([node(1, 0), node(2, 1), node(3, 2), node(4, 1), node(5, 99)])).toEqual([0, 1, 2, 1, 0]);
});
