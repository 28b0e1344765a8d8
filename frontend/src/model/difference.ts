import { childrenOf, parentsOf, type Diagram, type DiagramNode, type NodeId } from './diagram';

export type ChangeKind = 'added' | 'removed' | 'changed' | 'moved';

/** One property of a node before and after; null: not set. */
export interface FieldChange {
  /** `type`, `name`, `comment`…, or the name of a port or condition. */
  readonly field: string;
  readonly before: string | null;
  readonly after: string | null;
}

export interface NodeDifference {
  readonly kind: ChangeKind;
  readonly fields: readonly FieldChange[];
  /** Whether the node has another parent, or another place among its siblings. */
  readonly isMoved: boolean;
}

export interface TreeDifference {
  /** The newer tree, with the removed nodes at their old places. */
  readonly merged: Diagram;
  readonly changes: ReadonlyMap<NodeId, NodeDifference>;
}

const FIELDS = ['type', 'name', 'tree', 'comment', 'color', 'disabled'] as const;

function textsOf(node: DiagramNode): Map<string, string> {
  const texts = new Map<string, string>();
  for (const field of FIELDS) if (node[field] !== undefined) texts.set(field, String(node[field]));
  for (const part of [node.ports, node.conditions, node.attributes]) {
    for (const [name, text] of Object.entries(part ?? {})) texts.set(name, text);
  }
  return texts;
}

function fieldChanges(older: DiagramNode, newer: DiagramNode): FieldChange[] {
  const before = textsOf(older);
  const after = textsOf(newer);
  return [...new Set([...before.keys(), ...after.keys()])]
    .map((field) => ({ field, before: before.get(field) ?? null, after: after.get(field) ?? null }))
    .filter((change) => change.before !== change.after);
}

/** Returns the place of each node: its parent, and its rank among the siblings that both trees contain. */
function placesOf(diagram: Diagram, other: Diagram): Map<NodeId, string> {
  const elsewhere = parentsOf(other);
  const places = new Map<NodeId, string>();
  for (const id of Object.keys(diagram.nodes)) {
    childrenOf(diagram, id)
      .filter((child) => elsewhere.get(child) === id)
      .forEach((child, rank) => places.set(child, `${id} ${rank}`));
  }
  for (const [child, parent] of parentsOf(diagram)) {
    if (!places.has(child)) places.set(child, parent);
  }
  for (const draft of diagram.drafts) places.set(draft, '');
  return places;
}

/** Adds removed nodes at their old places, after their former previous siblings. */
function merge(older: Diagram, newer: Diagram, removed: ReadonlySet<NodeId>): Diagram {
  const nodes: Record<NodeId, DiagramNode> = {};
  for (const [id, node] of Object.entries(newer.nodes)) nodes[id] = { ...node, collapsed: false };
  for (const id of removed) {
    const node = older.nodes[id] ?? { type: '' };
    const children = childrenOf(older, id).filter((child) => removed.has(child));
    nodes[id] = { ...node, collapsed: false, disabled: true, children };
  }
  const drafts = [...newer.drafts];
  const parents = parentsOf(older);
  for (const id of removed) {
    const parent = parents.get(id);
    if (parent !== undefined && removed.has(parent)) continue;
    const host = parent === undefined ? undefined : nodes[parent];
    if (parent === undefined || !host) {
      drafts.push(id);
      continue;
    }
    const siblings = childrenOf(older, parent);
    const now = [...(host.children ?? [])];
    const earlier = siblings.slice(0, siblings.indexOf(id)).filter((sibling) => now.includes(sibling));
    now.splice(earlier.length === 0 ? 0 : now.indexOf(earlier.at(-1) ?? '') + 1, 0, id);
    nodes[parent] = { ...host, children: now };
  }
  const alone = newer.root === null ? drafts.indexOf(older.root ?? '') : -1;
  const root = alone < 0 ? newer.root : older.root;
  return { ...newer, root, nodes, drafts: drafts.filter((id) => id !== root) };
}

/** Returns the changed nodes between two states of a tree. */
export function treeDifference(older: Diagram, newer: Diagram): TreeDifference {
  const changes = new Map<NodeId, NodeDifference>();
  const removed = new Set(Object.keys(older.nodes).filter((id) => !(id in newer.nodes)));
  const before = placesOf(older, newer);
  const after = placesOf(newer, older);
  for (const [id, node] of Object.entries(newer.nodes)) {
    const old = older.nodes[id];
    if (!old) {
      changes.set(id, { kind: 'added', fields: [], isMoved: false });
      continue;
    }
    const fields = fieldChanges(old, node);
    const isMoved = before.get(id) !== after.get(id);
    if (fields.length > 0) changes.set(id, { kind: 'changed', fields, isMoved });
    else if (isMoved) changes.set(id, { kind: 'moved', fields, isMoved });
  }
  for (const id of removed) changes.set(id, { kind: 'removed', fields: [], isMoved: false });
  return { merged: merge(older, newer, removed), changes };
}
