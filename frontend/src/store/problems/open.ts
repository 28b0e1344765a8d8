import type { NodeId } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { focusField, openFile, openTopics, openTree } from '@/store/project/navigation';
import type { ListedProblem } from './list';

export interface BlockPlace {
  readonly tree: string;
  readonly node: NodeId;
  /** The port or script that is meant; it gets the focus. */
  readonly port?: string | undefined;
}

/** Selects a block, brings it into view, and moves the focus into the field of the port that is meant. */
export function openBlock({ tree, node, port }: BlockPlace): void {
  openTree(tree);
  useProjectStore.getState().reveal(tree, node);
  if (port) focusField(port);
}

/** Shows the place of a finding: the line of a fault, the block of a finding in a tree, or the topics. */
export function openProblem({ isFault, tree, node, port, file, line, topic }: ListedProblem): void {
  if (file !== null && (isFault || tree === null || node === null)) openFile(file, line ?? undefined);
  else if (tree !== null) {
    if (node === null) openTree(tree);
    else openBlock({ tree, node, port });
  } else if (topic !== null) openTopics();
}
