import type { TreeNode } from '@/generated/messages';

/** Returns the depth of each node of a tree in pre-order; the root has 0. */
export function depthsOf(tree: readonly TreeNode[]): number[] {
  const depths = new Map<number, number>([[0, -1]]);
  return tree.map(({ uid, parent }) => {
    const depth = (depths.get(parent) ?? -1) + 1;
    depths.set(uid, depth);
    return depth;
  });
}
