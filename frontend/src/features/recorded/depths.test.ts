import { expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { depthsOf } from './depths';

it('counts the levels from the root, which has 0', () => {
  const tree = [
    [1, 0],
    [2, 1],
    [3, 2],
    [4, 1],
  ].map(([uid, parent]) => ({ uid, parent }) as TreeNode);
  expect(depthsOf(tree)).toEqual([0, 1, 2, 1]);
});
