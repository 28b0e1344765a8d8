import { childrenOf, type NodeId } from '@/model/diagram';
import { bestPlacement } from '@/model/rules';
import { activeDiagram, placeAfter } from '@/store/project/edits/blocks';
import { setEditor, type QuickAddGoal } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';

/** Opens the quick-add box at a point of the window. */
export function openQuickAdd(tree: string, goal: QuickAddGoal, x: number, y: number, text = ''): void {
  setEditor({ quickAdd: { tree, goal, x, y, text } });
}

export function openQuickAddBelow(tree: string, parent: NodeId, x: number, y: number): void {
  const diagram = activeDiagram();
  if (!diagram) return;
  const index = childrenOf(diagram, parent).length;
  openQuickAdd(tree, { does: 'add', place: { at: 'child', parent, index } }, x, y);
}

/** Returns the position of a block in the window; the middle of the canvas if it is not drawn. */
export function pointOf(id: NodeId | undefined): { x: number; y: number } {
  const block = id === undefined ? null : document.querySelector(`[data-testid="node-${CSS.escape(id)}"]`);
  const box = (block ?? document.querySelector('[data-testid="canvas"]'))?.getBoundingClientRect();
  if (!box) return { x: 200, y: 200 };
  return block ? { x: box.left, y: box.bottom + 8 } : { x: box.left + box.width / 2 - 160, y: box.top + 80 };
}

/** Opens the quick-add box at the selected block, for the keyboard. */
export function openQuickAddHere(what: 'child' | 'after' | 'wrap' | 'morph', text = ''): void {
  const diagram = activeDiagram();
  if (!diagram) return;
  const { selection, vocabulary } = useProjectStore.getState();
  const [id] = selection;
  const { x, y } = pointOf(id);
  const open = (goal: QuickAddGoal): void => {
    openQuickAdd(diagram.id, goal, x, y, text);
  };
  if (what === 'wrap') {
    if (selection.length > 0) open({ does: 'wrap', nodes: selection });
  } else if (what === 'morph') {
    if (id !== undefined) open({ does: 'morph', node: id });
  } else if (what === 'after' && id !== undefined) {
    open({ does: 'add', place: placeAfter(diagram, id) });
  } else {
    open({ does: 'add', place: bestPlacement(diagram, id, vocabulary) });
  }
}
