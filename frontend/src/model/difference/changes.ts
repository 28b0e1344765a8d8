import { childrenOf, parentsOf, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import { compare, type Operation } from './operations';

export type ChangeKind = 'added' | 'removed' | 'changed' | 'moved';

/** One property of a node before and after; null: not set. */
export interface FieldChange {
  /** `type`, `name`, `comment`…, or the name of a port or condition. */
  readonly field: string;
  readonly before: string | null;
  readonly after: string | null;
}

/** The changes of a node, except those of its fields. */
export type Deed = 'wrapped' | 'unwrapped' | 'moved' | 'reordered' | null;

export interface NodeDifference {
  readonly kind: ChangeKind;
  readonly fields: readonly FieldChange[];
  readonly deed: Deed;
}

export interface TreeDifference {
  /** The newer tree, with the removed nodes at their old places. */
  readonly merged: Diagram;
  readonly changes: ReadonlyMap<NodeId, NodeDifference>;
  /** The id in the newer tree of each node of the older one that both have. */
  readonly pairs: ReadonlyMap<NodeId, NodeId>;
}

/** Adds removed nodes at their old places, after their former previous siblings. */
function merge(
  older: Diagram,
  newer: Diagram,
  removed: ReadonlySet<NodeId>,
  pairs: ReadonlyMap<NodeId, NodeId>,
): Diagram {
  const nodes: Record<NodeId, DiagramNode> = {};
  for (const [id, node] of Object.entries(newer.nodes)) nodes[id] = { ...node, collapsed: false };
  for (const id of removed) {
    const node = older.nodes[id] ?? { type: '' };
    const children = childrenOf(older, id).filter((child) => removed.has(child));
    nodes[id] = { ...node, collapsed: false, disabled: true, children };
  }
  const drafts = [...newer.drafts];
  const parents = parentsOf(older);
  const now = (id: NodeId): NodeId => pairs.get(id) ?? id;
  for (const id of removed) {
    const parent = parents.get(id);
    if (parent !== undefined && removed.has(parent)) continue;
    const host = parent === undefined ? undefined : nodes[now(parent)];
    if (parent === undefined || !host) {
      drafts.push(id);
      continue;
    }
    const siblings = childrenOf(older, parent).map(now);
    const there = [...(host.children ?? [])];
    const earlier = siblings.slice(0, siblings.indexOf(id)).filter((sibling) => there.includes(sibling));
    there.splice(earlier.length === 0 ? 0 : there.indexOf(earlier.at(-1) ?? '') + 1, 0, id);
    nodes[now(parent)] = { ...host, children: there };
  }
  const alone = newer.root === null ? drafts.indexOf(older.root ?? '') : -1;
  const root = alone < 0 ? newer.root : older.root;
  return { ...newer, root, nodes, drafts: drafts.filter((id) => id !== root) };
}

const DEEDS: Readonly<Record<Operation['op'], Deed>> = {
  wrap: 'wrapped',
  unwrap: 'unwrapped',
  move: 'moved',
  reorder: 'reordered',
  insert: null,
  delete: null,
  rename: null,
  change: null,
};

function kindOf(operation: Operation): ChangeKind {
  switch (operation.op) {
    case 'insert':
    case 'wrap':
      return 'added';
    case 'delete':
    case 'unwrap':
      return 'removed';
    case 'move':
    case 'reorder':
      return 'moved';
    default:
      return 'changed';
  }
}

function fieldIn(operation: Operation): readonly FieldChange[] {
  if (operation.op === 'rename') {
    return [{ field: 'name', before: operation.before, after: operation.after }];
  }
  if (operation.op !== 'change') return [];
  // The page shows a port by its own name.
  const field = operation.field.replace(/^(?:ports|conditions|attributes)\./, '');
  return [{ field, before: operation.before, after: operation.after }];
}

/** Returns the changed nodes between two states of a tree. */
export function treeDifference(older: Diagram, newer: Diagram): TreeDifference {
  const { pairs, operations } = compare(older, newer);
  const changes = new Map<NodeId, NodeDifference>();
  const removed = new Set<NodeId>();
  for (const operation of operations) {
    const { node } = operation;
    if (node === '') continue;
    const kind = kindOf(operation);
    const known = changes.get(node);
    if (kind === 'removed') removed.add(node);
    changes.set(node, {
      kind: known?.kind ?? kind,
      fields: [...(known?.fields ?? []), ...fieldIn(operation)],
      deed: known?.deed ?? DEEDS[operation.op],
    });
  }
  return { merged: merge(older, newer, removed, pairs), changes, pairs };
}
