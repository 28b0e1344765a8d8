import { useProjectStore } from '@/store/project';
import { openFile, openTopics, openTree } from '@/store/project/navigation';
import type { ListedProblem } from './list';

/** Shows the place of a finding: of a fault its line, of a finding in a tree its block, or the topics. */
export function openProblem({ isFault, tree, node, file, line, topic }: ListedProblem): void {
  if (file !== null && (isFault || tree === null || node === null)) openFile(file, line ?? undefined);
  else if (tree !== null) {
    openTree(tree);
    if (node !== null) useProjectStore.getState().reveal(tree, node);
  } else if (topic !== null) openTopics();
}
