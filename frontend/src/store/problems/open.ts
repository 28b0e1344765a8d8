import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import type { ListedProblem } from './list';

/** Opens the place of a finding: the line of a fault, the block of a finding in a tree. */
export function openProblem({ isFault, tree, node, file, line }: ListedProblem): void {
  if (file !== null && (isFault || tree === null || node === null)) openFile(file, line ?? undefined);
  else if (tree !== null) {
    openTree(tree);
    if (node !== null) useProjectStore.getState().reveal(tree, node);
  }
}
