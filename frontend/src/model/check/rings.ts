import type { Vocabulary } from '../vocabulary';

/** Finds trees that call each other, like `closing_calls` of `translator/check/subtree.py`. */

type Closing = ReadonlyMap<string, ReadonlySet<string>>;

function find({ trees, mainTree }: Vocabulary): Closing {
  const closing = new Map<string, Set<string>>();
  const done = new Set<string>();
  const calls = (tree: string): string[] => [...(trees.get(tree)?.calls ?? [])];
  for (const start of [mainTree, ...[...trees.keys()].sort()]) {
    if (done.has(start) || !trees.has(start)) continue;
    const above = [{ tree: start, left: calls(start) }];
    for (let last = above.at(-1); last; last = above.at(-1)) {
      const target = last.left.shift();
      if (target === undefined) {
        done.add(last.tree);
        above.pop();
      } else if (above.some(({ tree }) => tree === target)) {
        closing.set(last.tree, (closing.get(last.tree) ?? new Set()).add(target));
      } else if (trees.has(target) && !done.has(target)) {
        above.push({ tree: target, left: calls(target) });
      }
    }
  }
  return closing;
}

const known = new WeakMap<Vocabulary, Closing>();

/** Returns for each tree the calls that close a cycle, when the trees are visited from the main tree. */
export function closingCalls(vocabulary: Vocabulary): Closing {
  const found = known.get(vocabulary) ?? find(vocabulary);
  known.set(vocabulary, found);
  return found;
}
