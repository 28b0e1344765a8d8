/** Types and simple queries of diagram JSON, `trees/<TreeID>.json` (docs/reference: formats). */

export type NodeId = string;
export type Orientation = 'vertical' | 'horizontal';
export type Point = readonly [x: number, y: number];

export interface DiagramNode {
  readonly type: string;
  readonly name?: string;
  /** The ID of the called tree; only a `SubTree` has one. */
  readonly tree?: string;
  readonly ports?: Readonly<Record<string, string>>;
  readonly children?: readonly NodeId[];
  /** `_skipIf`, `_while`, `_onSuccess` and the like. */
  readonly conditions?: Readonly<Record<string, string>>;
  readonly comment?: string;
  readonly color?: string;
  readonly disabled?: boolean;
  readonly collapsed?: boolean;
  /** The codes of findings that are not reported at the node, each with the reason. */
  readonly silenced?: Readonly<Record<string, string>>;
  readonly position?: Point;
  /** Unknown attributes of an imported XML element, kept for the export. */
  readonly attributes?: Readonly<Record<string, string>>;
}

export interface Diagram {
  readonly format: 'bt-studio/diagram';
  /** 2 if a node has `silenced`. */
  readonly version: 1 | 2;
  readonly id: string;
  readonly root: NodeId | null;
  readonly nodes: Readonly<Record<NodeId, DiagramNode>>;
  /** Roots of unconnected pieces: saved, but never translated. */
  readonly drafts: readonly NodeId[];
  readonly layout: Orientation;
  /** The ports that the tree has as a SubTree, unparsed; `treeFacts` reads them. */
  readonly ports?: unknown;
  /** Attributes of its `<BehaviorTree>`; `treeAttributes` reads them. */
  readonly attributes?: Readonly<Record<string, string>>;
  /** Decisions that a merge has left, unparsed; `conflicts` reads them. */
  readonly conflicts?: unknown;
}

export function emptyDiagram(id: string): Diagram {
  return {
    format: 'bt-studio/diagram',
    version: 1,
    id,
    root: null,
    nodes: {},
    drafts: [],
    layout: 'vertical',
  };
}

const NO_CHILDREN: readonly NodeId[] = [];

export function childrenOf(diagram: Diagram, id: NodeId): readonly NodeId[] {
  return diagram.nodes[id]?.children ?? NO_CHILDREN;
}

/** Returns the parent of every node; roots and drafts are absent. */
export function parentsOf(diagram: Diagram): ReadonlyMap<NodeId, NodeId> {
  const parents = new Map<NodeId, NodeId>();
  for (const [id, node] of Object.entries(diagram.nodes)) {
    for (const child of node.children ?? []) parents.set(child, id);
  }
  return parents;
}

export function parentOf(diagram: Diagram, id: NodeId): NodeId | null {
  for (const parent in diagram.nodes) {
    if (diagram.nodes[parent]?.children?.includes(id)) return parent;
  }
  return null;
}

/** Returns the root, if there is one, then the drafts. */
export function topsOf(diagram: Diagram): readonly NodeId[] {
  return diagram.root === null ? diagram.drafts : [diagram.root, ...diagram.drafts];
}

/** Returns `id` and all nodes below it, in pre-order. */
export function subtreeOf(diagram: Diagram, id: NodeId): NodeId[] {
  const found: NodeId[] = [];
  const open = [id];
  for (let next = open.pop(); next !== undefined; next = open.pop()) {
    const node = diagram.nodes[next];
    if (!node) continue;
    found.push(next);
    const children = node.children ?? NO_CHILDREN;
    for (let i = children.length - 1; i >= 0; i -= 1) open.push(children[i] ?? '');
  }
  return found;
}

/** Returns all nodes in pre-order: the tree in execution order, then the drafts. */
export function preorder(diagram: Diagram): NodeId[] {
  return topsOf(diagram).flatMap((top) => subtreeOf(diagram, top));
}

export function isWithin(diagram: Diagram, id: NodeId, ancestor: NodeId): boolean {
  return subtreeOf(diagram, ancestor).includes(id);
}

/** Returns the selected nodes that have no selected ancestor, in execution order. */
export function topmost(diagram: Diagram, ids: Iterable<NodeId>): NodeId[] {
  const wanted = new Set(ids);
  const parents = parentsOf(diagram);
  const covered = (id: NodeId): boolean => {
    for (let up = parents.get(id); up !== undefined; up = parents.get(up)) {
      if (wanted.has(up)) return true;
    }
    return false;
  };
  return preorder(diagram).filter((id) => wanted.has(id) && !covered(id));
}

/** Returns the displayed name of a node: its instance name, otherwise its tree, otherwise its type. */
export function displayName(node: DiagramNode): string {
  return node.name ?? node.tree ?? node.type;
}

/**
 * Returns a node id that the diagram does not contain; `random` is an argument so that tests are repeatable.
 */
export function freshId(
  taken: Readonly<Record<NodeId, unknown>>,
  random: () => number = Math.random,
): NodeId {
  for (;;) {
    const id = `n${Math.floor(random() * 36 ** 6)
      .toString(36)
      .padStart(6, '0')}`;
    if (!(id in taken)) return id;
  }
}
