import type { NodeId } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { openFile, openTopics, openTree } from '@/store/project/navigation';
import type { ListedProblem } from './list';

/** Shows the block of a step of a reason. */
export function openStep({ tree, node }: { readonly tree: string; readonly node: NodeId }): void {
  openTree(tree);
  useProjectStore.getState().reveal(tree, node);
}

/** Shows the place of a finding: the line of a fault, the block of a finding in a tree, or the topics. */
export function openProblem({ isFault, tree, node, file, line, topic }: ListedProblem): void {
  if (file !== null && (isFault || tree === null || node === null)) openFile(file, line ?? undefined);
  else if (tree !== null) {
    openTree(tree);
    if (node !== null) useProjectStore.getState().reveal(tree, node);
  } else if (topic !== null) openTopics();
}
