import { Position, type Edge, type Node, type NodeHandle } from '@xyflow/react';
import {
  childrenOf,
  displayName,
  subtreeOf,
  type Diagram,
  type DiagramNode,
  type NodeId,
} from '@/model/diagram';
import type { ExpandedTree, Inside } from '@/model/expand';
import { visibleChildren, type Box, type Layout } from '@/model/layout';
import { acceptsChild } from '@/model/rules';
import { specOf, type NodeSpec, type Vocabulary } from '@/model/vocabulary';
import type { ShownProblem } from '@/store/project/problems';

export interface BlockData extends Record<string, unknown> {
  readonly tree: string;
  readonly node: DiagramNode;
  readonly spec: NodeSpec | undefined;
  readonly problem: ShownProblem | null;
  readonly isDraft: boolean;
  readonly isHorizontal: boolean;
  readonly canGrow: boolean;
  /** The number of blocks that are hidden below this one; 0 unless it is folded. */
  readonly folded: number;
  /** Whether a SubTree is expanded; null if the block cannot be expanded. */
  readonly look: 'closed' | 'open' | null;
  /** The block's tree and node, if it is shown inside of an expanded SubTree. */
  readonly inside: Inside | null;
}

export type BlockNode = Node<BlockData, 'block' | 'tiny'>;
export type TreeEdge = Edge<{ tree: string; node: NodeId; isHorizontal: boolean }, 'tree'>;

export interface FlowInput {
  readonly diagram: Diagram;
  readonly shown: ExpandedTree;
  readonly layout: Layout;
  readonly vocabulary: Vocabulary;
  readonly problems: ReadonlyMap<NodeId, ShownProblem>;
  readonly selection: ReadonlySet<NodeId>;
  /** Whether nothing can be added to the tree. */
  readonly isReadOnly?: boolean;
}

/**
 * Returns the ends of a block's connections. They are computed and not measured, so that they are right as
 * soon as blocks change.
 */
function handlesOf({ width, height }: Box, isHorizontal: boolean): NodeHandle[] {
  const end = (type: 'source' | 'target', position: Position, x: number, y: number): NodeHandle => ({
    type,
    position,
    x,
    y,
    width: 0,
    height: 0,
  });
  return isHorizontal
    ? [end('target', Position.Left, 0, height / 2), end('source', Position.Right, width, height / 2)]
    : [end('target', Position.Top, width / 2, 0), end('source', Position.Bottom, width / 2, height)];
}

const FACTS = [
  'tree',
  'node',
  'spec',
  'problem',
  'isDraft',
  'isHorizontal',
  'canGrow',
  'folded',
  'look',
  'inside',
] as const satisfies readonly (keyof BlockData)[];

const sameData = (a: BlockData, b: BlockData): boolean => FACTS.every((key) => a[key] === b[key]);

/** Returns the earlier list if no element has changed, otherwise the new one. */
function kept<T>(before: readonly T[], now: T[]): T[] {
  const isSame = before.length === now.length && now.every((each, index) => each === before[index]);
  return isSame ? (before as T[]) : now;
}

const isSame = (a: Inside, b: Inside): boolean => a.tree === b.tree && a.node === b.node;

function lookOf(
  id: NodeId,
  node: DiagramNode,
  { shown, vocabulary, isReadOnly }: FlowInput,
): BlockData['look'] {
  if (isReadOnly || node.type !== 'SubTree' || !node.tree || !vocabulary.trees.has(node.tree)) return null;
  return shown.groups.has(id) ? 'open' : 'closed';
}

/**
 * Projects a tree to React Flow's nodes. Unchanged nodes and lists keep their identity, so that React renders
 * only changed nodes and React Flow need not compare the lists.
 */
export class FlowProjection {
  private nodes = new Map<NodeId, BlockNode>();
  private edges = new Map<NodeId, TreeEdge>();
  private nodeList: BlockNode[] = [];
  private edgeList: TreeEdge[] = [];

  project(input: FlowInput): { nodes: BlockNode[]; edges: TreeEdge[] } {
    const { diagram, layout } = input;
    const shown = input.shown.diagram;
    const drafts = new Set(diagram.drafts.flatMap((top) => subtreeOf(diagram, top)));
    const nodes = new Map<NodeId, BlockNode>();
    const edges = new Map<NodeId, TreeEdge>();
    for (const [id, box] of Object.entries(layout.positions)) {
      const node = shown.nodes[id];
      if (!node) continue;
      nodes.set(id, this.nodeFor(id, node, box, drafts.has(id), input));
      for (const child of visibleChildren(shown, id))
        edges.set(child, this.edgeFor(id, child, diagram, input.shown.inside.get(child) ?? null));
    }
    this.nodes = nodes;
    this.edges = edges;
    this.nodeList = kept(this.nodeList, [...nodes.values()]);
    this.edgeList = kept(this.edgeList, [...edges.values()]);
    return { nodes: this.nodeList, edges: this.edgeList };
  }

  private nodeFor(id: NodeId, node: DiagramNode, box: Box, isDraft: boolean, input: FlowInput): BlockNode {
    const { diagram, vocabulary, problems, selection } = input;
    const known = this.nodes.get(id);
    const inside = input.shown.inside.get(id) ?? null;
    const data: BlockData = {
      tree: diagram.id,
      node,
      spec: specOf(vocabulary, node),
      problem: problems.get(id) ?? null,
      isDraft,
      isHorizontal: diagram.layout === 'horizontal',
      canGrow: !input.isReadOnly && acceptsChild(diagram, id, vocabulary),
      folded: node.collapsed ? subtreeOf(input.shown.diagram, id).length - 1 : 0,
      look: lookOf(id, node, input),
      inside: known?.data.inside && inside && isSame(known.data.inside, inside) ? known.data.inside : inside,
    };
    const { x, y } = box;
    const sameContent = known !== undefined && sameData(known.data, data);
    if (
      known &&
      sameContent &&
      known.position.x === x &&
      known.position.y === y &&
      known.width === box.width &&
      known.height === box.height &&
      known.selected === selection.has(id)
    ) {
      return known;
    }
    return {
      id,
      type: 'block',
      position: { x, y },
      width: box.width,
      height: box.height,
      measured: { width: box.width, height: box.height },
      handles: handlesOf(box, data.isHorizontal),
      selected: selection.has(id),
      data: sameContent ? known.data : data,
      ariaLabel: displayName(node),
      // An accessible name requires a role, even when the canvas is zoomed out and the block shows no text.
      ariaRole: 'group',
      ...(inside ? { draggable: false, selectable: false, connectable: false } : {}),
    };
  }

  private edgeFor(parent: NodeId, child: NodeId, diagram: Diagram, inside: Inside | null): TreeEdge {
    const known = this.edges.get(child);
    const isHorizontal = diagram.layout === 'horizontal';
    if (
      known?.source === parent &&
      known.data?.isHorizontal === isHorizontal &&
      known.data.tree === (inside?.tree ?? diagram.id)
    ) {
      return known;
    }
    return {
      // A block has one parent, so its own id also identifies the edge to it.
      id: child,
      type: 'tree',
      source: parent,
      target: child,
      data: { tree: inside?.tree ?? diagram.id, node: inside?.node ?? child, isHorizontal },
      focusable: false,
      selectable: inside === null,
    };
  }
}

/** Marks the dragged block, so that it is drawn even while the canvas has scrolled it out of view. */
export function withHeld(nodes: readonly BlockNode[], held: NodeId | null): BlockNode[] {
  if (held === null) return nodes as BlockNode[];
  return nodes.map((node) => (node.id === held ? { ...node, dragging: true } : node));
}

/** Returns the blocks of a tree that is seen as a whole: their places alone, since its picture shows them. */
export const asTiny = (nodes: readonly BlockNode[]): BlockNode[] =>
  nodes.map((node) => ({ ...node, type: 'tiny' }));

/** Returns the position of a node among its siblings for screen readers: "2 of 3". */
export function ordinal(
  diagram: Diagram,
  parent: NodeId | null,
  id: NodeId,
): { index: number; count: number } {
  const siblings = parent === null ? [id] : childrenOf(diagram, parent);
  return { index: siblings.indexOf(id) + 1, count: siblings.length };
}
