import type { Draft } from 'immer';
import { subtreeOf, topmost, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import type { Kind, Placement } from '../rules';
import { asPlain, attach, detach, nodeOf, placementOf, type Recipe } from './core';

export function addNode(id: NodeId, node: DiagramNode, place: Placement): Recipe {
  return (draft) => {
    draft.nodes[id] = { ...(node as Draft<DiagramNode>) };
    attach(draft, id, place);
  };
}

/** Moves a node with its subtree. The index counts the children before the move. */
export function moveNode(id: NodeId, place: Placement): Recipe {
  return moveNodes([id], place);
}

/** Moves nodes with their subtrees, side by side in this order; none of them may be below another. */
export function moveNodes(ids: readonly NodeId[], place: Placement): Recipe {
  return (draft) => {
    let target = place;
    if (place.at === 'child') {
      const before = (nodeOf(draft, place.parent).children ?? []).slice(0, place.index);
      target = { ...place, index: place.index - before.filter((child) => ids.includes(child)).length };
    }
    for (const id of ids) detach(draft, id);
    ids.forEach((id, offset) => {
      attach(draft, id, target.at === 'child' ? { ...target, index: target.index + offset } : target);
    });
  };
}

/** Moves siblings by this many places, each past unselected siblings; if one cannot move, none moves. */
export function reorder(ids: readonly NodeId[], by: number): Recipe {
  return (draft) => {
    const [first] = ids;
    const from = first === undefined ? null : placementOf(draft, first);
    if (from?.at !== 'child') return;
    const parent = nodeOf(draft, from.parent);
    const children = [...(parent.children ?? [])];
    const step = Math.sign(by);
    for (let left = Math.abs(by); left > 0; left -= 1) {
      const places = ids.map((id) => children.indexOf(id)).sort((a, b) => (b - a) * step);
      if (places.some((at) => at < 0 || children[at + step] === undefined)) break;
      for (const at of places) children.splice(at + step, 0, ...children.splice(at, 1));
      parent.children = [...children];
    }
  };
}

/** Removes nodes with their subtrees. */
export function removeSubtrees(ids: readonly NodeId[]): Recipe {
  return (draft) => {
    const before = asPlain(draft);
    for (const id of topmost(before, ids)) {
      const gone = subtreeOf(before, id);
      detach(draft, id);
      for (const each of gone) delete draft.nodes[each];
    }
  };
}

/**
 * Removes a node and puts its children in its place. At the top, the first child becomes the root and the
 * others become drafts.
 */
export function unwrap(id: NodeId): Recipe {
  return (draft) => {
    const children = [...(nodeOf(draft, id).children ?? [])];
    const place = placementOf(draft, id);
    delete nodeOf(draft, id).children;
    detach(draft, id);
    delete draft.nodes[id];
    children.forEach((child, offset) => {
      if (place.at === 'child') attach(draft, child, { ...place, index: place.index + offset });
      else attach(draft, child, offset === 0 ? place : { at: 'draft' });
    });
  };
}

/**
 * Inserts a new node above the given siblings, at the place of the first; the order of the siblings stays.
 */
export function wrap(ids: readonly NodeId[], id: NodeId, kind: Kind): Recipe {
  return (draft) => {
    const inside = topmost(asPlain(draft), ids);
    const [first] = inside;
    if (first === undefined) return;
    const place = placementOf(draft, first);
    const position = nodeOf(draft, first).position;
    inside.forEach((each) => {
      detach(draft, each);
    });
    draft.nodes[id] = { ...kind };
    attach(draft, id, place);
    if (place.at === 'draft' && position) nodeOf(draft, id).position = [position[0], position[1]];
    inside.forEach((each, index) => {
      attach(draft, each, { at: 'child', parent: id, index });
    });
  };
}

/** Changes the type of a node in place, and drops the ports for which `keepPort` is false. */
export function morph(id: NodeId, kind: Kind, keepPort: (name: string) => boolean): Recipe {
  return (draft) => {
    const node = nodeOf(draft, id);
    node.type = kind.type;
    if (kind.tree === undefined) delete node.tree;
    else node.tree = kind.tree;
    const kept = Object.entries(node.ports ?? {}).filter(([name]) => keepPort(name));
    if (kept.length > 0) node.ports = Object.fromEntries(kept);
    else delete node.ports;
  };
}

/** A piece of a tree outside of any diagram: from the clipboard, a duplicate, or another tree. */
export interface Fragment {
  readonly tops: readonly NodeId[];
  readonly nodes: Readonly<Record<NodeId, DiagramNode>>;
}

/** Copies nodes with their subtrees. */
export function fragmentOf(diagram: Diagram, ids: readonly NodeId[]): Fragment {
  const tops = topmost(diagram, ids);
  const nodes: Record<NodeId, DiagramNode> = {};
  for (const id of tops.flatMap((top) => subtreeOf(diagram, top))) {
    const node = diagram.nodes[id];
    if (node) nodes[id] = node;
  }
  return { tops, nodes };
}

/** Returns a copy of a fragment in which every node has a new id. */
export function withFreshIds(
  fragment: Fragment,
  fresh: (taken: Record<NodeId, unknown>) => NodeId,
): Fragment {
  const names = new Map<NodeId, NodeId>();
  const taken: Record<NodeId, unknown> = {};
  for (const id of Object.keys(fragment.nodes)) {
    const name = fresh(taken);
    taken[name] = true;
    names.set(id, name);
  }
  const renamed = (id: NodeId): NodeId => names.get(id) ?? id;
  return {
    tops: fragment.tops.map(renamed),
    nodes: Object.fromEntries(
      Object.entries(fragment.nodes).map(([id, node]) => [
        renamed(id),
        node.children ? { ...node, children: node.children.map(renamed) } : node,
      ]),
    ),
  };
}

/** Returns the place after a node. */
function after(draft: Draft<Diagram>, id: NodeId): Placement {
  const place = placementOf(draft, id);
  return place.at === 'child' ? { ...place, index: place.index + 1 } : place;
}

/** Adds a fragment, whose ids must be new to the diagram. */
export function insertFragment(fragment: Fragment, place: Placement): Recipe {
  return (draft) => {
    for (const [id, node] of Object.entries(fragment.nodes)) {
      draft.nodes[id] = {
        ...(node as Draft<DiagramNode>),
        ...(node.children ? { children: [...node.children] } : {}),
      };
    }
    fragment.tops.forEach((top, offset) => {
      let target: Placement = place;
      if (place.at === 'child') target = { ...place, index: place.index + offset };
      else if (place.at === 'beside' && offset > 0) target = after(draft, fragment.tops[offset - 1] ?? '');
      else if (place.at === 'root' && offset > 0) target = { at: 'draft' };
      else if (place.at === 'draft' && place.position) {
        target = { at: 'draft', position: [place.position[0] + 40 * offset, place.position[1]] };
      }
      attach(draft, top, target);
    });
  };
}
