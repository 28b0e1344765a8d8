import type { Diagram, DiagramNode, NodeId } from './diagram';

/** The real tree and node of a block that is shown inside of a SubTree. */
export interface Inside {
  readonly tree: string;
  readonly node: NodeId;
}

/** A tree as it is drawn, with the trees of its expanded SubTrees. */
export interface ExpandedTree {
  readonly diagram: Diagram;
  /** The real place of each block that belongs to another tree. */
  readonly inside: ReadonlyMap<NodeId, Inside>;
  /** The blocks inside of each expanded SubTree, nested ones included. */
  readonly groups: ReadonlyMap<NodeId, readonly NodeId[]>;
}

const NOTHING: Pick<ExpandedTree, 'inside' | 'groups'> = { inside: new Map(), groups: new Map() };

/** Returns the id of a block inside of a SubTree. It contains a blank, which no id in a diagram has. */
const innerId = (outer: NodeId, inner: NodeId): NodeId => `${outer} ${inner}`;

/**
 * Adds the tree of every SubTree in `expanded` below the SubTree, for display only: these blocks have other
 * ids, and no manual positions.
 */
export function expandTrees(
  diagram: Diagram,
  diagrams: Readonly<Record<string, Diagram>>,
  expanded: ReadonlySet<NodeId>,
): ExpandedTree {
  if (expanded.size === 0) return { diagram, ...NOTHING };
  const nodes: Record<NodeId, DiagramNode> = { ...diagram.nodes };
  const inside = new Map<NodeId, Inside>();
  const groups = new Map<NodeId, readonly NodeId[]>();

  const open = (id: NodeId): NodeId[] => {
    const node = nodes[id];
    const tree = node?.type === 'SubTree' && node.tree ? diagrams[node.tree] : undefined;
    if (!node || !tree || tree.root === null || !expanded.has(id)) return [];
    const put = (inner: NodeId): NodeId[] => {
      const found = tree.nodes[inner];
      if (!found) return [];
      const own = innerId(id, inner);
      const { position: _, ...rest } = found;
      const children = found.children?.map((child) => innerId(id, child));
      nodes[own] = children ? { ...rest, children } : rest;
      inside.set(own, { tree: tree.id, node: inner });
      const below = found.collapsed ? [] : (found.children ?? []);
      return [own, ...open(own), ...below.flatMap(put)];
    };
    const blocks = put(tree.root);
    nodes[id] = { ...node, children: [innerId(id, tree.root)] };
    groups.set(id, blocks);
    return blocks;
  };

  for (const id of Object.keys(diagram.nodes)) open(id);
  return { diagram: { ...diagram, nodes }, inside, groups };
}
