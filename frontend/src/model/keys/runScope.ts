import type { Forest } from './scope';

/** The tree of a scope of a run, a path of SubTrees by name or `ID::number`; null if it is not known. */
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
