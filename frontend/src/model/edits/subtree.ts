import {
  childrenOf,
  emptyDiagram,
  subtreeOf,
  topmost,
  type Diagram,
  type DiagramNode,
  type NodeId,
} from '../diagram';
import { readPortText } from '../ports';
import { attach, detach, nodeOf, placementOf, type Recipe } from './core';
import { fragmentOf, withFreshIds, type Fragment } from './structure';

/** Returns the blackboard keys of a fragment, which become the ports of a subtree made from it. */
function keysIn(fragment: Fragment): string[] {
  const keys = new Set<string>();
  for (const node of Object.values(fragment.nodes)) {
    for (const [name, text] of Object.entries(node.ports ?? {})) {
      const value = readPortText(text);
      if (value.kind === 'key' && !value.global) keys.add(value.key);
      if (value.kind === 'same-name') keys.add(name);
    }
  }
  return [...keys].sort();
}

/**
 * Moves siblings to a new tree. A SubTree in their place passes each key that they use. Several siblings get
 * a root node that executes them as their parent did.
 */
export function extractSubtree(
  diagram: Diagram,
  ids: readonly NodeId[],
  treeId: string,
  fresh: () => NodeId,
): { tree: Diagram; recipe: Recipe } | null {
  const tops = topmost(diagram, ids);
  const [first] = tops;
  if (first === undefined) return null;
  const fragment = fragmentOf(diagram, tops);
  const nodes: Record<NodeId, DiagramNode> = { ...fragment.nodes };
  let root = first;
  if (tops.length > 1) {
    root = fresh();
    const parent = Object.values(diagram.nodes).find((node) => node.children?.includes(first));
    // In other parents, such as IfThenElse, each child has its own role.
    const type = parent && /Sequence|Fallback|Parallel/.test(parent.type) ? parent.type : 'Sequence';
    nodes[root] = { type, children: [...tops] };
  }
  const tree: Diagram = { ...emptyDiagram(treeId), root, nodes, layout: diagram.layout };
  const ports = Object.fromEntries(keysIn(fragment).map((key) => [key, `{${key}}`]));
  const id = fresh();
  const recipe: Recipe = (draft) => {
    const place = placementOf(draft, first);
    for (const top of tops) detach(draft, top);
    for (const gone of tops.flatMap((top) => subtreeOf(diagram, top))) delete draft.nodes[gone];
    draft.nodes[id] = { type: 'SubTree', tree: treeId, ...(Object.keys(ports).length > 0 ? { ports } : {}) };
    attach(draft, id, place);
  };
  return { tree, recipe };
}

/** Replaces the subtree's keys with the values that its SubTree node passes for them. */
function remapped(node: DiagramNode, passed: Readonly<Record<string, string>>): DiagramNode {
  if (!node.ports) return node;
  const ports = Object.entries(node.ports).map(([name, text]) => {
    const value = readPortText(text);
    const key = value.kind === 'key' && !value.global ? value.key : value.kind === 'same-name' ? name : null;
    return [name, key === null ? text : (passed[key] ?? text)];
  });
  return { ...node, ports: Object.fromEntries(ports) as Record<string, string> };
}

/** Replaces a SubTree node by a copy of its tree. */
export function inlineSubtree(
  id: NodeId,
  tree: Diagram,
  fresh: (taken: Record<NodeId, unknown>) => NodeId,
): Recipe {
  return (draft) => {
    if (tree.root === null) return;
    const passed = { ...nodeOf(draft, id).ports };
    const copy = withFreshIds(fragmentOf(tree, [tree.root]), (taken) => fresh({ ...draft.nodes, ...taken }));
    const place = placementOf(draft, id);
    detach(draft, id);
    delete draft.nodes[id];
    for (const [key, node] of Object.entries(copy.nodes)) {
      const {
        ports,
        children,
        conditions,
        attributes,
        position: _position,
        ...rest
      } = remapped(node, passed);
      draft.nodes[key] = {
        ...rest,
        ...(ports ? { ports: { ...ports } } : {}),
        ...(children ? { children: [...children] } : {}),
        ...(conditions ? { conditions: { ...conditions } } : {}),
        ...(attributes ? { attributes: { ...attributes } } : {}),
      };
    }
    const [top] = copy.tops;
    if (top !== undefined) attach(draft, top, place);
  };
}

/** Returns whether nodes are consecutive children of one parent, so that they can be extracted together. */
export function areNeighbours(diagram: Diagram, ids: readonly NodeId[]): boolean {
  const tops = topmost(diagram, ids);
  if (tops.length < 2) return tops.length === 1;
  const parent = Object.keys(diagram.nodes).find((id) => childrenOf(diagram, id).includes(tops[0] ?? ''));
  if (parent === undefined) return false;
  const places = tops.map((top) => childrenOf(diagram, parent).indexOf(top));
  return places.every((place, index) => place >= 0 && place === (places[0] ?? 0) + index);
}
