import type { Forest } from './scope';

/**
 * Returns the tree of a run's scope, which is a path of SubTrees by name or `ID::number`; null if it is
 * unknown.
 */
export function treeOfScope({ diagrams, mainTree }: Forest, scope: string): string | null {
  let tree = mainTree;
  for (const step of scope.split('/').filter(Boolean)) {
    const calls = Object.values(diagrams[tree]?.nodes ?? {}).filter(({ type }) => type === 'SubTree');
    const id = step.replace(/::\d+$/, '');
    const call = calls.find(({ name }) => name === step) ?? calls.find((node) => node.tree === id);
    if (!call?.tree) return null;
    tree = call.tree;
  }
  return tree in diagrams ? tree : null;
}
