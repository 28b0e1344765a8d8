import { useMemo } from 'react';
import type { TreeNode } from '@/generated/messages';
import { useMoment } from '@/store/moment/store';

type Named = Pick<TreeNode, 'uid' | 'parent' | 'name' | 'path'>;

/** Returns the names that lead to each block, by its path in the run; blocks with the same names are numbered. */
export function namesOf(tree: readonly Named[]): ReadonlyMap<string, string> {
  const names = new Map<number, string>();
  const counts = new Map<string, number>();
  return new Map(
    // A parent stands before its children.
    tree.map(({ uid, parent, name, path }) => {
      const above = names.get(parent);
      const whole = above === undefined ? name : `${above} › ${name}`;
      names.set(uid, whole);
      const count = (counts.get(whole) ?? 0) + 1;
      counts.set(whole, count);
      return [path, count > 1 ? `${whole} (${count})` : whole];
    }),
  );
}

/** Returns a function that names a block of the shown moment by the blocks that lead to it. */
export function useBlockNames(): (path: string) => string {
  const tree = useMoment((state) => state.tree);
  const names = useMemo(() => namesOf(tree), [tree]);
  return (path) => names.get(path) ?? path;
}
