import { childrenOf, type Diagram, type NodeId } from '@/model/diagram';
import { setCollapsed } from '@/model/edits';
import { activeDiagram, change } from '@/store/project/edits/blocks';
import { setEditor, toggleExpanded } from '@/store/project/editor';
import { openAction, openTree } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';

/** The block that keys and menus act on. */
export const firstSelected = (): NodeId | undefined => useProjectStore.getState().selection[0];

/** Opens what a block stands for: the code of an action, the tree of a subtree, else its name. */
export function openBlock(diagram: Diagram, id: NodeId): void {
  const node = diagram.nodes[id];
  if (!node) return;
  const spec = useProjectStore.getState().vocabulary.specs.get(node.type);
  if (node.type === 'SubTree' && node.tree) openTree(node.tree);
  else if (spec?.source === 'action') openAction(node.type);
  else setEditor({ editing: { node: id, field: 'name' } });
}

/** Writes the selected block's name or comment where it stands. */
export function editSelected(field: 'name' | 'comment'): void {
  const node = firstSelected();
  if (node !== undefined) setEditor({ editing: { node, field } });
}

/** Folds the selected block's children away, or shows them again. */
export function toggleFolded(): void {
  const id = firstSelected();
  const diagram = activeDiagram();
  if (!diagram || id === undefined || childrenOf(diagram, id).length === 0) return;
  const folded = diagram.nodes[id]?.collapsed === true;
  change(folded ? 'unfold' : 'fold', [setCollapsed(id, !folded)]);
}

/** Shows the subtree that the selected block stands for in its place, or no longer. */
export function toggleInside(): void {
  const id = firstSelected();
  const diagram = activeDiagram();
  if (diagram && id !== undefined) toggleExpanded(diagram.id, id);
}
