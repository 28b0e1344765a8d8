import {
  childrenOf,
  freshId,
  parentOf,
  topmost,
  type Diagram,
  type DiagramNode,
  type NodeId,
} from '@/model/diagram';
import {
  addNode,
  fragmentOf,
  insertFragment,
  moveNode,
  moveNodes,
  morph,
  removeSubtrees,
  reorder,
  setDisabled,
  unwrap,
  withFreshIds,
  wrap,
  type Recipe,
} from '@/model/edits';
import {
  acceptsChild,
  bestPlacement,
  canMoveUnder,
  canUnwrap,
  hasRoom,
  type Kind,
  type Placement,
} from '@/model/rules';
import type { QuickAddGoal } from '../editor';
import { filesFor, offeredSpec } from '../offered';
import { useProjectStore } from '../index';
import { liveKey, useLiveStore } from '../live';
import { problemsOf } from '../problems';
import type { EditOptions } from '../state';

const store = () => useProjectStore.getState();

/** Returns the active tree; null if none is open. */
export function activeDiagram(): Diagram | null {
  const { activeTree, diagrams } = store();
  return activeTree === null ? null : (diagrams[activeTree] ?? null);
}

/** Returns whether the editor or the server has found a problem in a block of the active tree. */
export function hasProblem(id: NodeId | undefined): boolean {
  const diagram = activeDiagram();
  const { vocabulary, diagnostics } = store();
  if (!diagram || id === undefined) return false;
  if (useLiveStore.getState().faults.has(liveKey(diagram.id, id))) return true;
  return problemsOf(diagram, vocabulary, diagnostics).some((problem) => problem.node === id);
}

export function change(label: string, recipes: readonly Recipe[], options?: EditOptions): void {
  const { activeTree, apply } = store();
  if (activeTree !== null) apply(activeTree, label, recipes, options);
}

function kindNode(kind: Kind): DiagramNode {
  return kind.tree === undefined ? { type: kind.type } : { type: kind.type, tree: kind.tree };
}

export function addAt(kind: Kind, place: Placement): NodeId | null {
  const diagram = activeDiagram();
  if (!diagram) return null;
  const id = freshId(diagram.nodes);
  change('add', [addNode(id, kindNode(kind), place)], { select: [id], ...filesFor(kind) });
  return id;
}

/** Adds a block at the best place for the current selection, after a click in the palette. */
export function addHere(kind: Kind): NodeId | null {
  const diagram = activeDiagram();
  if (!diagram) return null;
  return addAt(kind, bestPlacement(diagram, store().selection[0], store().vocabulary));
}

/** Carries out the goal of the quick-add box with the chosen kind. */
export function achieve(goal: QuickAddGoal, kind: Kind): void {
  const diagram = activeDiagram();
  if (!diagram) return;
  switch (goal.does) {
    case 'add':
      addAt(kind, goal.place);
      return;
    case 'wrap': {
      const id = freshId(diagram.nodes);
      change('wrap', [wrap(goal.nodes, id, kind)], { select: [id], ...filesFor(kind) });
      return;
    }
    case 'morph': {
      const spec = store().vocabulary.specs.get(kind.type) ?? offeredSpec(kind.type);
      const keeps = (name: string) => spec?.open !== false || spec.ports.some((port) => port.name === name);
      change('morph', [morph(goal.node, kind, keeps)], { select: [goal.node], ...filesFor(kind) });
    }
  }
}

/**
 * Returns the block to select after these blocks are removed: the next sibling, the previous one, or the
 * parent.
 */
function neighbourOf(diagram: Diagram, ids: readonly NodeId[]): NodeId[] {
  const [first] = topmost(diagram, ids);
  if (first === undefined) return [];
  const parent = parentOf(diagram, first);
  if (parent === null) return [];
  const siblings = childrenOf(diagram, parent);
  const at = siblings.indexOf(first);
  const next = [...siblings.slice(at + 1), ...siblings.slice(0, at).reverse()].find(
    (id) => !ids.includes(id),
  );
  return [next ?? parent];
}

export function deleteSelection(): void {
  const diagram = activeDiagram();
  const { selection } = store();
  if (!diagram || selection.length === 0) return;
  change('delete', [removeSubtrees(selection)], { select: neighbourOf(diagram, selection) });
}

/** Removes the selected block alone; its children take its place. */
export function unwrapSelection(): void {
  const diagram = activeDiagram();
  const [id] = store().selection;
  if (!diagram || id === undefined || !canUnwrap(diagram, id, store().vocabulary)) return;
  change('unwrap', [unwrap(id)], { select: childrenOf(diagram, id) });
}

export function toggleDisabled(): void {
  const diagram = activeDiagram();
  const { selection } = store();
  if (!diagram || selection.length === 0) return;
  const enable = selection.every((id) => diagram.nodes[id]?.disabled);
  change(enable ? 'enable' : 'disable', [setDisabled(selection, !enable)]);
}

interface Company {
  readonly diagram: Diagram;
  readonly parent: NodeId;
  readonly ids: readonly NodeId[];
}

/**
 * Returns the selected blocks that the keyboard moves together: all of them if they are siblings, otherwise
 * the first.
 */
function selectedSiblings(): Company | null {
  const diagram = activeDiagram();
  const { selection } = store();
  const [first] = selection;
  if (!diagram || first === undefined) return null;
  const parent = parentOf(diagram, first);
  if (parent === null) return null;
  const tops = topmost(diagram, selection);
  const areSiblings = tops.every((id) => childrenOf(diagram, parent).includes(id));
  return { diagram, parent, ids: areSiblings ? tops : [first] };
}

/** Moves the selected blocks among their siblings. */
export function reorderSelection(by: number): void {
  const found = selectedSiblings();
  if (found) change('reorder', [reorder(found.ids, by)]);
}

/** Moves the selected blocks out of their parent, to the place after it. */
export function moveOut(): void {
  const found = selectedSiblings();
  if (!found) return;
  const { diagram, parent, ids } = found;
  const above = parentOf(diagram, parent);
  if (above === null || !hasRoom(diagram, above, store().vocabulary, ids.length)) return;
  const index = childrenOf(diagram, above).indexOf(parent) + 1;
  change('move', [moveNodes(ids, { at: 'child', parent: above, index })]);
}

/** Moves the selected blocks under the previous sibling, or under the next one. */
export function moveIn(): void {
  const found = selectedSiblings();
  if (!found) return;
  const { diagram, parent, ids } = found;
  const siblings = childrenOf(diagram, parent);
  const places = ids.map((id) => siblings.indexOf(id));
  const target = [siblings[Math.min(...places) - 1], siblings[Math.max(...places) + 1]].find(
    (other) => other !== undefined && hasRoom(diagram, other, store().vocabulary, ids.length),
  );
  if (target === undefined) return;
  const index = childrenOf(diagram, target).length;
  change('move', [moveNodes(ids, { at: 'child', parent: target, index })]);
}

/** Moves a block under another one; used for a connection that the user draws. */
export function connect(parent: NodeId, child: NodeId): boolean {
  const diagram = activeDiagram();
  if (!diagram || !canMoveUnder(diagram, child, parent, store().vocabulary)) return false;
  change('connect', [moveNode(child, { at: 'child', parent, index: childrenOf(diagram, parent).length })], {
    select: [child],
  });
  return true;
}

/** Removes the connection to the parent; the block becomes a draft at its current place. */
export function disconnect(id: NodeId, position: readonly [number, number]): void {
  change('disconnect', [moveNode(id, { at: 'draft', position })], { select: [id] });
}

/** Returns the place after the selected block if its parent has room, otherwise the best other place. */
export function placeAfter(diagram: Diagram, id: NodeId): Placement {
  const parent = parentOf(diagram, id);
  const { vocabulary } = store();
  if (parent !== null && acceptsChild(diagram, parent, vocabulary)) {
    return { at: 'child', parent, index: childrenOf(diagram, parent).indexOf(id) + 1 };
  }
  return bestPlacement(diagram, id, vocabulary);
}

export function duplicateSelection(): void {
  const diagram = activeDiagram();
  const { selection } = store();
  if (!diagram) return;
  const last = topmost(diagram, selection).at(-1);
  if (last === undefined) return;
  const copy = withFreshIds(fragmentOf(diagram, selection), (taken) =>
    freshId({ ...diagram.nodes, ...taken }),
  );
  change('duplicate', [insertFragment(copy, placeAfter(diagram, last))], { select: copy.tops });
}
