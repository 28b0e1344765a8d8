import { childrenOf, type Diagram, type NodeId } from '@/model/diagram';
import { setCollapsed } from '@/model/edits';
import { activeDiagram, change } from '@/store/project/edits/blocks';
import { setEditor, toggleExpanded } from '@/store/project/editor';
import { openAction, openTree } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';

/** Returns the block that keys and menus act on. */
export const firstSelected = (): NodeId | undefined => useProjectStore.getState().selection[0];

/** Opens the block's document: the code of an action or the tree of a subtree; otherwise edits its name. */
export function openBlock(diagram: Diagram, id: NodeId): void {
  const node = diagram.nodes[id];
  if (!node) return;
  const spec = useProjectStore.getState().vocabulary.specs.get(node.type);
  if (node.type === 'SubTree' && node.tree) openTree(node.tree);
  else if (spec?.source === 'action') openAction(node.type);
  else setEditor({ editing: { node: id, field: 'name' } });
}

/** Starts editing the selected block's name or comment in the block. */
export function editSelected(field: 'name' | 'comment'): void {
  const node = firstSelected();
  if (node !== undefined) setEditor({ editing: { node, field } });
}

/** Folds or unfolds the children of the selected block. */
export function toggleFolded(): void {
  const id = firstSelected();
  const diagram = activeDiagram();
  if (!diagram || id === undefined || childrenOf(diagram, id).length === 0) return;
  const folded = diagram.nodes[id]?.collapsed === true;
  change(folded ? 'unfold' : 'fold', [setCollapsed(id, !folded)]);
}

/** Expands or collapses the subtree of the selected block in place. */
export function toggleInside(): void {
  const id = firstSelected();
  const diagram = activeDiagram();
  if (diagram && id !== undefined) toggleExpanded(diagram.id, id);
}
