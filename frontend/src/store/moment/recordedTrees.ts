import type { Diagram, DiagramNode, NodeId } from '@/model/diagram';
import { parseDiagram } from '@/model/serialize';
import type { RecordedNode } from '@/store/recording/types';

/** The id of the tree of a log whose nodes were not made of diagrams. */
export const FOREIGN_TREE = 'recorded';

/** A tree as it ran. */
export interface RecordedTree {
  readonly diagram: Diagram;
  /** Whether it is the attached file; else it is made of the nodes that ran, without comments and the like. */
  readonly isAttached: boolean;
}

/** Returns the file in a recording that holds the diagram of a tree. */
export const attachedName = (tree: string): string => `project/trees/${tree}.json`;

/** Returns the nodes of a recorded tree; those of a foreign log get ids, so that they can be shown as blocks. */
export function identified(nodes: readonly RecordedNode[]): readonly RecordedNode[] {
  if (nodes.some(({ node_id }) => node_id !== '')) return nodes;
  return nodes.map((node) => ({ ...node, node_id: `n${node.uid}`, tree_id: FOREIGN_TREE }));
}

/**
 * Returns the diagrams of the trees that ran, by id: as their files were attached, where these hold every node
 * that ran, otherwise made of the recorded nodes. The main tree is the first.
 *
 * @param nodes the nodes of a generation, in pre-order.
 * @param files the attached files, by their names in the recording.
 */
export function recordedTrees(
  nodes: readonly RecordedNode[],
  files: Readonly<Record<string, string>>,
): Readonly<Record<string, RecordedTree>> {
  const made = new Map<string, Maker>();
  const seen = new Map<number, RecordedNode>();
  for (const node of nodes) {
    // A node whose parent does not precede it is hostile data; it becomes a separate draft.
    const parent = seen.get(node.parent);
    seen.set(node.uid, node);
    if (parent && parent.tree_id !== node.tree_id) made.get(parent.tree_id)?.call(parent, node.tree_id);
    if (node.node_id === '') continue;
    let maker = made.get(node.tree_id);
    if (!maker) made.set(node.tree_id, (maker = new Maker(node.tree_id)));
    maker.add(node, parent);
  }
  return Object.fromEntries(
    [...made].map(([id, maker]) => {
      const diagram = attached(id, files, maker.nodes);
      return [id, { diagram: diagram ?? maker.diagram(), isAttached: diagram !== null }];
    }),
  );
}

type Nodes = ReadonlyMap<NodeId, DiagramNode>;

/** Returns the attached diagram of a tree, if it holds every node that ran. */
function attached(id: string, files: Readonly<Record<string, string>>, ran: Nodes): Diagram | null {
  const text = files[attachedName(id)];
  if (text === undefined) return null;
  try {
    const diagram = parseDiagram(text);
    const holds = [...ran].every(([node, { type }]) => diagram.nodes[node]?.type === type);
    return holds ? unfolded({ ...diagram, id, nodes: withPorts(diagram.nodes, ran) }) : null;
  } catch {
    return null;
  }
}

/** Returns the blocks of a file with the port texts that ran: a port may be changed while the tree runs. */
function withPorts(nodes: Diagram['nodes'], ran: Nodes): Diagram['nodes'] {
  const given = Object.entries(nodes).map(([id, node]) => {
    const texts = ran.get(id)?.ports;
    if (!texts || !node.ports) return [id, node];
    const ports = Object.entries(node.ports).map(([port, text]) => [port, texts[port] ?? text]);
    return [id, { ...node, ports: Object.fromEntries(ports) as typeof node.ports }];
  });
  return Object.fromEntries(given) as Diagram['nodes'];
}

/** Returns a diagram that hides nothing, since the tree that is shown cannot be unfolded. */
function unfolded(diagram: Diagram): Diagram {
  const nodes = Object.entries(diagram.nodes).map(([id, node]) => [id, { ...node, collapsed: false }]);
  return { ...diagram, nodes: Object.fromEntries(nodes) as Diagram['nodes'] };
}

/** Makes the diagram of one tree of its recorded nodes; of several instances, the first counts. */
class Maker {
  readonly nodes = new Map<NodeId, DiagramNode>();
  private readonly children = new Map<NodeId, NodeId[]>();
  private readonly tops: NodeId[] = [];

  constructor(private readonly id: string) {}

  add(node: RecordedNode, parent: RecordedNode | undefined): void {
    const { node_id: id, type, ports } = node;
    if (this.nodes.has(id)) return;
    const name = node.name.replace(/::\d+$/, '');
    this.nodes.set(id, {
      type,
      ...(name === type || name === '' ? {} : { name }),
      ...(Object.keys(ports).length === 0 ? {} : { ports }),
    });
    if (parent?.tree_id !== this.id || parent.node_id === '') this.tops.push(id);
    else this.children.set(parent.node_id, [...(this.children.get(parent.node_id) ?? []), id]);
  }

  /** Notes which tree a SubTree calls. */
  call({ node_id: id }: RecordedNode, tree: string): void {
    const node = this.nodes.get(id);
    if (!node || tree === '') return;
    const { name, ...rest } = node;
    this.nodes.set(id, { ...rest, tree, ...(name === undefined || name === tree ? {} : { name }) });
  }

  diagram(): Diagram {
    const [root = null, ...drafts] = this.tops;
    const nodes = [...this.nodes].map(([id, node]) => {
      const children = this.children.get(id);
      return [id, children ? { ...node, children } : node] as const;
    });
    const head = { format: 'bt-studio/diagram', version: 1, id: this.id } as const;
    return { ...head, root, nodes: Object.fromEntries(nodes), drafts, layout: 'vertical' };
  }
}
