import type { Diagram, DiagramNode, NodeId } from '../diagram';

/** Where a node stands: below a parent, or as the root, or among the drafts. */
export type Place = { readonly parent: NodeId } | 'root' | 'draft';

/** A field of a node or of the tree; a record such as `ports` has one for each of its keys. */
export type Field = readonly [name: string, key?: string];

/**
 * A change of one thing that an ID names, so that it still says the same after changes of others: positions in
 * lists would not. A value of null stands for an absent field. The ID '' names the tree itself.
 */
export type Operation =
  | { readonly op: 'create'; readonly id: NodeId; readonly node: Childless }
  | { readonly op: 'set'; readonly id: NodeId; readonly field: Field; readonly value: unknown }
  | { readonly op: 'place'; readonly id: NodeId; readonly at: Place; readonly after: NodeId | null }
  | { readonly op: 'remove'; readonly id: NodeId };

export type Childless = Omit<DiagramNode, 'children'>;

/** The ID of the tree itself. */
export const TREE = '';

const RECORDS = new Set(['ports', 'conditions', 'silenced', 'attributes']);
/** What other operations say, or nothing may change. */
const NO_FIELDS = new Set(['children', 'format', 'id', 'root', 'nodes', 'drafts']);

const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** Returns whether two values of JSON are equal; an absent field equals one that is undefined. */
export function isSame(a: unknown, b: unknown): boolean {
  if (a === b) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  if (Array.isArray(a) !== Array.isArray(b)) return false;
  const [first, second] = [a as Readonly<Record<string, unknown>>, b as Readonly<Record<string, unknown>>];
  return [...new Set([...Object.keys(a), ...Object.keys(b)])].every((key) => isSame(first[key], second[key]));
}

/** Returns the fields of a node or a tree by their names joined by a slash. */
export function fieldsOf(thing: object): Map<string, readonly [Field, unknown]> {
  const found = new Map<string, readonly [Field, unknown]>();
  for (const [name, value] of Object.entries(thing)) {
    if (NO_FIELDS.has(name) || value === undefined) continue;
    if (RECORDS.has(name) && isRecord(value)) {
      for (const [key, part] of Object.entries(value)) found.set(`${name}/${key}`, [[name, key], part]);
    } else found.set(name, [[name], value]);
  }
  return found;
}

/** Returns the value of a field; null if it is absent. */
export function valueOf(thing: object, [name, key]: Field): unknown {
  const value = (thing as Readonly<Record<string, unknown>>)[name] ?? null;
  if (key === undefined) return value;
  return isRecord(value) && Object.hasOwn(value, key) ? (value[key] ?? null) : null;
}

/** Returns the thing with a field set, or without it for null. */
export function withValue<T extends object>(thing: T, [name, key]: Field, value: unknown): T {
  const { [name]: before, ...others } = thing as T & Readonly<Record<string, unknown>>;
  let next = value;
  if (key !== undefined) {
    const entries = Object.entries(isRecord(before) ? before : {}).filter(([each]) => each !== key);
    if (value !== null) entries.push([key, value]);
    next = entries.length > 0 ? Object.fromEntries(entries) : null;
  }
  return (next === null ? others : { ...others, [name]: next }) as T;
}

/** Returns the place of each node. */
export function placesOf(diagram: Diagram): Map<NodeId, Place> {
  const found = new Map<NodeId, Place>();
  for (const [parent, node] of Object.entries(diagram.nodes)) {
    for (const child of node.children ?? []) found.set(child, { parent });
  }
  for (const draft of diagram.drafts) found.set(draft, 'draft');
  if (diagram.root !== null) found.set(diagram.root, 'root');
  return found;
}
