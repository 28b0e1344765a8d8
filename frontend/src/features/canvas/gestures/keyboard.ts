import type { KeyboardEvent } from 'react';
import { childrenOf, parentOf, topsOf, type Diagram, type NodeId } from '@/model/diagram';
import type { Inside } from '@/model/expand';
import { visibleChildren } from '@/model/layout';
import {
  activeDiagram,
  deleteSelection,
  moveIn,
  moveOut,
  reorderSelection,
  unwrapSelection,
} from '@/store/project/edits/blocks';
import { openTree } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { editSelected, openBlock, toggleFolded, toggleInside } from '../commands/selectedBlock';
import { openQuickAddHere } from '../quickAdd/open';

/** Keys that press a focused button or move the focus. */
const PRESSES: ReadonlySet<string> = new Set(['Enter', ' ', 'Tab']);

type Direction = 'up' | 'down' | 'before' | 'after';

/** The directions of the arrow keys on the screen: in a left-right layout, the parent is to the left. */
const DIRECTIONS: Record<Diagram['layout'], Readonly<Record<string, Direction>>> = {
  vertical: { ArrowUp: 'up', ArrowDown: 'down', ArrowLeft: 'before', ArrowRight: 'after' },
  horizontal: { ArrowLeft: 'up', ArrowRight: 'down', ArrowUp: 'before', ArrowDown: 'after' },
};

/**
 * Returns the next block in a direction. Among siblings this is the next one, or the nearest cousin after the
 * last one.
 */
export function neighbour(diagram: Diagram, id: NodeId, direction: Direction): NodeId | null {
  if (direction === 'up') return parentOf(diagram, id);
  if (direction === 'down') return visibleChildren(diagram, id)[0] ?? null;
  const parent = parentOf(diagram, id);
  const step = direction === 'after' ? 1 : -1;
  const siblings = parent === null ? topsOf(diagram) : childrenOf(diagram, parent);
  const beside = siblings[siblings.indexOf(id) + step];
  if (beside !== undefined) return beside;
  if (parent === null) return null;
  const uncle = neighbour(diagram, parent, direction);
  if (uncle === null) return null;
  const cousins = visibleChildren(diagram, uncle);
  return (direction === 'after' ? cousins[0] : cousins.at(-1)) ?? uncle;
}

/** Returns the block to which a key leads from a block, or from none; null for another key. */
export function neighbourByKey(diagram: Diagram, id: NodeId | null, key: string): NodeId | null {
  if (key === 'Home') return diagram.root;
  const direction = DIRECTIONS[diagram.layout][key];
  if (!direction) return null;
  return id === null ? diagram.root : neighbour(diagram, id, direction);
}

function move(direction: Direction): void {
  if (direction === 'before' || direction === 'after') reorderSelection(direction === 'after' ? 1 : -1);
  else if (direction === 'up') moveOut();
  else moveIn();
}

function walk(diagram: Diagram, id: NodeId | undefined, direction: Direction, extend: boolean): void {
  const { select, selection } = useProjectStore.getState();
  const next = id === undefined ? diagram.root : neighbour(diagram, id, direction);
  if (next === null) return;
  // The new block comes first, since keys act on the first one.
  select(diagram.id, extend ? [next, ...selection.filter((other) => other !== next)] : [next]);
}

/** Opens the tree of a block that is shown inside of a SubTree. */
export function enterInside({ tree, node }: Inside): void {
  openTree(tree);
  useProjectStore.getState().reveal(tree, node);
}

/** Handles keys on a selected block; returns true if it handled the key. */
function onBlockKey(event: KeyboardEvent, diagram: Diagram, id: NodeId): boolean {
  switch (event.key) {
    case 'Tab':
      if (event.shiftKey) return false;
      openQuickAddHere('child');
      return true;
    case 'Enter':
      if (event.ctrlKey || event.metaKey) openQuickAddHere('after');
      else openBlock(diagram, id);
      return true;
    case 'F2':
      editSelected('name');
      return true;
    case '/':
      editSelected('comment');
      return true;
    case 'Delete':
    case 'Backspace':
      if (event.shiftKey) unwrapSelection();
      else deleteSelection();
      return true;
    case ' ':
      if (diagram.nodes[id]?.type === 'SubTree') toggleInside();
      else toggleFolded();
      return true;
    default:
      return false;
  }
}

/** Returns whether a key opens the context menu: the menu key, or Shift+F10 for keyboards without one. */
export const isMenuKey = ({ key, shiftKey, ctrlKey, metaKey }: KeyboardEvent): boolean =>
  key === 'ContextMenu' || (key === 'F10' && shiftKey && !ctrlKey && !metaKey);

/** Handles the keys of the canvas. Keys with Ctrl that apply to the whole page are in the command table. */
export function onCanvasKey(event: KeyboardEvent): void {
  const target = event.target as HTMLElement;
  // React also delivers the key events of a menu, although the menu is elsewhere in the DOM.
  if (!event.currentTarget.contains(target)) return;
  if (target.matches('input, textarea, select, [contenteditable=true]')) return;
  if (target.matches('button') && PRESSES.has(event.key)) return;
  const diagram = activeDiagram();
  if (!diagram) return;
  const { selection, select } = useProjectStore.getState();
  const [id] = selection;
  const command = event.ctrlKey || event.metaKey;
  const direction = DIRECTIONS[diagram.layout][event.key];
  let done = true;
  if (direction) {
    if (command) move(direction);
    else walk(diagram, id, direction, event.shiftKey);
  } else if (event.key === 'Home' && diagram.root !== null) select(diagram.id, [diagram.root]);
  else if (event.key === 'Escape') {
    // If there is nothing to leave, the page handles the key.
    done = selection.length > 0;
    select(diagram.id, []);
  } else if (id !== undefined && onBlockKey(event, diagram, id)) done = true;
  else if (event.key === 'Tab' && !event.shiftKey && diagram.root === null) openQuickAddHere('child');
  else if (!command && !event.altKey && /^[a-z0-9_]$/i.test(event.key)) openQuickAddHere('child', event.key);
  else done = false;
  if (done) {
    event.preventDefault();
    event.stopPropagation();
  }
}
