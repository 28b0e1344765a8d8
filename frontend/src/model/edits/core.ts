import { current, enablePatches, isDraft, produceWithPatches, type Draft, type Patch } from 'immer';
import { freshId, parentOf, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import type { Placement } from '../rules';

enablePatches();

/** A change to a diagram, written as if the diagram were mutable; `edit()` makes it pure and invertible. */
export type Recipe = (draft: Draft<Diagram>) => void;

export interface Edited {
  readonly diagram: Diagram;
  readonly patches: readonly Patch[];
  readonly inverse: readonly Patch[];
}

/** Applies recipes in order; the input stays unchanged. */
export function edit(diagram: Diagram, ...recipes: readonly Recipe[]): Edited {
  const [next, patches, inverse] = produceWithPatches(diagram, (draft) => {
    for (const recipe of recipes) recipe(draft);
  });
  return { diagram: next, patches, inverse };
}

/** Returns a node. It must exist: recipes refer to visible nodes, so a missing node is a bug. */
export function nodeOf(draft: Draft<Diagram>, id: NodeId): Draft<DiagramNode> {
  const node = draft.nodes[id];
  if (!node) throw new Error(`There is no node ${id} in ${draft.id}.`);
  return node;
}

/**
 * Returns the current state of a draft for reading: reading the draft itself would create a draft of every
 * node.
 */
export function asPlain(draft: Draft<Diagram>): Diagram {
  return isDraft(draft) ? current(draft) : draft;
}

export function findParent(draft: Draft<Diagram>, id: NodeId): NodeId | null {
  return parentOf(asPlain(draft), id);
}

/** Returns the current place of a node. */
export function placementOf(draft: Draft<Diagram>, id: NodeId): Placement {
  if (draft.root === id) return { at: 'root' };
  const parent = findParent(draft, id);
  if (parent !== null)
    return { at: 'child', parent, index: nodeOf(draft, parent).children?.indexOf(id) ?? 0 };
  return { at: 'draft' };
}

/** Removes a node from its place; the same recipe must attach or delete it. */
export function detach(draft: Draft<Diagram>, id: NodeId): void {
  if (draft.root === id) draft.root = null;
  draft.drafts = draft.drafts.filter((other) => other !== id);
  const parent = findParent(draft, id);
  if (parent === null) return;
  const node = nodeOf(draft, parent);
  node.children = (node.children ?? []).filter((child) => child !== id);
  if (node.children.length === 0) delete node.children;
}

/** Attaches a detached node. A new root makes the old one a draft, so that nothing is lost. */
export function attach(draft: Draft<Diagram>, id: NodeId, place: Placement): void {
  switch (place.at) {
    case 'root':
      if (draft.root !== null) draft.drafts.push(draft.root);
      draft.root = id;
      delete nodeOf(draft, id).position;
      return;
    case 'beside':
      attachBeside(draft, id, place.node);
      return;
    case 'draft':
      draft.drafts.push(id);
      if (place.position) nodeOf(draft, id).position = [...place.position];
      return;
    case 'child': {
      const parent = nodeOf(draft, place.parent);
      const children = parent.children ?? [];
      children.splice(Math.max(0, Math.min(place.index, children.length)), 0, id);
      parent.children = children;
      delete nodeOf(draft, id).position;
      return;
    }
  }
}

/** Attaches a node after one whose parent has no room: a new Sequence takes its place and holds both. */
function attachBeside(draft: Draft<Diagram>, id: NodeId, beside: NodeId): void {
  const above = freshId(asPlain(draft).nodes);
  const place = placementOf(draft, beside);
  const { position } = nodeOf(draft, beside);
  detach(draft, beside);
  draft.nodes[above] = { type: 'Sequence' };
  attach(draft, above, place);
  if (place.at === 'draft' && position) nodeOf(draft, above).position = [position[0], position[1]];
  attach(draft, beside, { at: 'child', parent: above, index: 0 });
  attach(draft, id, { at: 'child', parent: above, index: 1 });
}

/** Sets an optional field, or removes it if the value is empty. */
export function assign<K extends keyof DiagramNode>(
  node: Draft<DiagramNode>,
  key: K,
  value: Draft<DiagramNode>[K] | undefined,
): void {
  if (value === undefined || value === '' || value === false) delete node[key];
  else node[key] = value;
}
