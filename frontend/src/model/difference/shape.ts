import { childrenOf, parentsOf, preorder, type Diagram, type DiagramNode, type NodeId } from '../diagram';

/** The parent of the root. Drafts have no parent: null. */
export const ROOT = '';
export type Parent = NodeId | null;

/** A diagram with its links in both directions, as `translator/difference/shape.py` has it. */
export interface Shape {
  readonly diagram: Diagram;
  readonly parents: ReadonlyMap<NodeId, Parent>;
  /** The tree in its order of execution, then the drafts. */
  readonly order: readonly NodeId[];
  readonly ranks: ReadonlyMap<NodeId, number>;
  /** The number of nodes of each branch. */
  readonly sizes: ReadonlyMap<NodeId, number>;
}

export function shapeOf(diagram: Diagram): Shape {
  const order = preorder(diagram);
  const parents = new Map<NodeId, Parent>(order.map((id) => [id, null]));
  if (diagram.root !== null) parents.set(diagram.root, ROOT);
  for (const [child, parent] of parentsOf(diagram)) parents.set(child, parent);
  const sizes = new Map<NodeId, number>();
  for (const id of [...order].reverse()) {
    sizes.set(
      id,
      childrenOf(diagram, id).reduce((sum, child) => sum + (sizes.get(child) ?? 0), 1),
    );
  }
  return { diagram, parents, order, ranks: new Map(order.map((id, rank) => [id, rank])), sizes };
}

/** Returns the children of a node, the root, or the drafts. */
export function below({ diagram }: Shape, parent: Parent): readonly NodeId[] {
  if (parent === null) return diagram.drafts;
  if (parent === ROOT) return diagram.root === null ? [] : [diagram.root];
  return childrenOf(diagram, parent);
}

/** Returns a node and all nodes below it, in order of execution. */
export function branchOf({ order, ranks, sizes }: Shape, id: NodeId): readonly NodeId[] {
  const start = ranks.get(id) ?? 0;
  return order.slice(start, start + (sizes.get(id) ?? 0));
}

export function parentIn(shape: Shape, id: NodeId): Parent {
  return shape.parents.get(id) ?? null;
}

export function indexIn(shape: Shape, id: NodeId): number {
  return below(shape, parentIn(shape, id)).indexOf(id);
}

const TEXTS = ['type', 'tree', 'comment', 'color', 'disabled'] as const;
const MAPS = ['ports', 'conditions', 'attributes', 'silenced'] as const;
const LAYOUT = ['position', 'collapsed'] as const;
const KNOWN: ReadonlySet<string> = new Set([...TEXTS, ...MAPS, ...LAYOUT, 'name', 'children']);

/** Orders texts by their code units, as Python does, whatever the language of the page. */
const byCode = (a: string, b: string) => (a < b ? -1 : a > b ? 1 : 0);

function sorted(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(sorted);
  if (typeof value !== 'object' || value === null) return value;
  const rows = Object.entries(value).sort(([a], [b]) => byCode(a, b));
  return Object.fromEntries(rows.map(([key, item]) => [key, sorted(item)]));
}

/** Returns a value as it is shown and compared. */
export function textOf(value: unknown): string {
  return typeof value === 'string' ? value : JSON.stringify(sorted(value));
}

function addMap(found: Map<string, string>, part: string, values: Readonly<Record<string, string>>): void {
  for (const key of Object.keys(values).sort(byCode)) found.set(`${part}.${key}`, textOf(values[key]));
}

/** Returns the fields of a node that differ from their defaults, by name (a port is `ports.<name>`). */
export function fieldsOf(node: DiagramNode, withLayout = false): Map<string, string> {
  const found = new Map<string, string>();
  for (const key of TEXTS) if (node[key]) found.set(key, textOf(node[key]));
  if (node.name !== undefined) found.set('name', node.name);
  for (const part of MAPS) addMap(found, part, node[part] ?? {});
  const rest = Object.entries(node).filter(([key]) => !KNOWN.has(key));
  for (const [key, value] of rest.sort(([a], [b]) => byCode(a, b))) found.set(key, textOf(value));
  if (withLayout) for (const key of LAYOUT) if (node[key]) found.set(key, textOf(node[key]));
  return found;
}

/** Returns the fields of a diagram, except its nodes, by name. */
export function treeFieldsOf(diagram: Diagram, withLayout = false): Map<string, string> {
  const found = new Map([['id', diagram.id]]);
  const ports = Array.isArray(diagram.ports) ? (diagram.ports as { readonly name: string }[]) : [];
  for (const { name, ...rest } of ports) found.set(`ports.${name}`, textOf(rest));
  addMap(found, 'attributes', diagram.attributes ?? {});
  if (withLayout && diagram.layout !== 'vertical') found.set('layout', diagram.layout);
  return found;
}
