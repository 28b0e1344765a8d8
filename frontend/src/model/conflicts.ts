import { displayName, isWithin, type Diagram, type NodeId } from './diagram';
import { moveNode, removeSubtrees, type Recipe } from './edits';
import { asPlain, nodeOf } from './edits/core';
import type { Placement } from './rules';
import { attributesOf } from './treeAttributes';
import type { Draft } from 'immer';

export type Side = 'ours' | 'theirs';

/** A decision that a merge has left, as `bt-studio merge` writes it; our side is in the tree. */
export interface Conflict {
  readonly op: string;
  /** Empty for the tree itself. */
  readonly node: NodeId;
  readonly field: string;
  readonly base: unknown;
  readonly ours: unknown;
  readonly theirs: unknown;
}

type Rows = Record<string, unknown>;

const isObject = (value: unknown): value is Rows =>
  typeof value === 'object' && value !== null && !Array.isArray(value);
const text = (value: unknown): string => (typeof value === 'string' ? value : '');

/** The attribute in which XML has the list. */
const ATTRIBUTE = '_bts_conflicts';

type Listed = Pick<Diagram, 'conflicts' | 'attributes'>;

/** Returns the entries of the file's list; the file is foreign, so entries of any form are kept. */
const ownEntries = ({ conflicts }: Listed): readonly unknown[] =>
  Array.isArray(conflicts) ? (conflicts as unknown[]) : [];

/** Returns the entries of a tree that comes from XML. */
function importedEntries(diagram: Listed): readonly unknown[] {
  const source = attributesOf(diagram)[ATTRIBUTE];
  if (source === undefined) return [];
  try {
    const found: unknown = JSON.parse(source);
    return Array.isArray(found) ? (found as unknown[]) : [{}];
  } catch {
    return [{}];
  }
}

const entriesOf = (diagram: Listed): readonly unknown[] => [
  ...ownEntries(diagram),
  ...importedEntries(diagram),
];

/** Returns the open decisions of a tree. */
export function conflictsOf(diagram: Listed): readonly Conflict[] {
  return entriesOf(diagram).map((entry) => {
    const row = isObject(entry) ? entry : {};
    const { base = null, ours = null, theirs = null } = row;
    return { op: text(row['op']), node: text(row['node']), field: text(row['field']), base, ours, theirs };
  });
}

/** One side of a decision: a text, a place, nodes, or nothing. */
export type Shown =
  | { readonly is: 'text'; readonly text: string }
  | { readonly is: 'place'; readonly parent: string | null; readonly place: number }
  | { readonly is: 'top' | 'draft' | 'deleted' | 'kept' | 'nothing' };

const nameOf = (diagram: Diagram, id: string): string => {
  const node = diagram.nodes[id];
  return node ? displayName(node) : id;
};

/** Returns the text of one side of a decision. */
export function shownSide(diagram: Diagram, conflict: Conflict, side: Side | 'base'): Shown {
  const value = conflict[side];
  if (conflict.op === 'delete') return { is: value === null ? 'deleted' : 'kept' };
  if (value === null) return { is: 'nothing' };
  if (isObject(value) && 'parent' in value) {
    const parent = value['parent'];
    if (parent === null) return { is: 'draft' };
    if (parent === '') return { is: 'top' };
    return { is: 'place', parent: nameOf(diagram, text(parent)), place: Number(value['index']) + 1 };
  }
  if (Array.isArray(value)) {
    return { is: 'text', text: value.map((id) => nameOf(diagram, text(id))).join(', ') };
  }
  if (conflict.op === 'root') return { is: 'text', text: nameOf(diagram, text(value)) };
  return { is: 'text', text: typeof value === 'string' ? value : JSON.stringify(value) };
}

function setIn(target: Rows, field: string, value: unknown): void {
  const [part = '', ...rest] = field.split('.');
  const key = rest.join('.');
  if (rest.length === 0 || !['ports', 'conditions', 'attributes'].includes(part)) {
    if (value === null) Reflect.deleteProperty(target, field);
    else target[field] = value;
    return;
  }
  const inside = target[part];
  if (Array.isArray(inside)) {
    // The ports of a tree are a list.
    const others = (inside as Rows[]).filter((port) => port['name'] !== key);
    target[part] = value === null ? others : [...others, value];
    return;
  }
  const entries = { ...(isObject(inside) ? inside : {}) };
  if (value === null) Reflect.deleteProperty(entries, key);
  else entries[key] = value;
  if (Object.keys(entries).length > 0) target[part] = entries;
  else Reflect.deleteProperty(target, part);
}

function placeOf(value: unknown): Placement | null {
  if (!isObject(value)) return null;
  const { parent, index } = value;
  if (parent === null) return { at: 'draft' };
  if (parent === '') return { at: 'root' };
  return { at: 'child', parent: text(parent), index: Number(index) };
}

/** Moves a node to its place on their side; a descendant that becomes its ancestor takes its old place first. */
function move(draft: Draft<Diagram>, id: NodeId, place: Placement): void {
  if (place.at === 'child') {
    const { parent } = place;
    if (!draft.nodes[parent]) return;
    const plain = asPlain(draft);
    if (parent === id) return;
    if (isWithin(plain, parent, id)) {
      const top = plain.nodes[id]?.children?.find((child) => isWithin(plain, parent, child));
      if (top === undefined) return;
      const above = Object.keys(plain.nodes).find((each) => plain.nodes[each]?.children?.includes(id));
      const index = above === undefined ? 0 : (plain.nodes[above]?.children?.indexOf(id) ?? 0);
      moveNode(top, above === undefined ? { at: 'root' } : { at: 'child', parent: above, index })(draft);
    }
  }
  moveNode(id, place)(draft);
}

function order(draft: Draft<Diagram>, id: NodeId, wanted: readonly unknown[]): void {
  const node = nodeOf(draft, id);
  const now = [...(node.children ?? [])];
  const known = now.filter((child) => wanted.includes(child));
  known.sort((a, b) => wanted.indexOf(a) - wanted.indexOf(b));
  node.children = now.map((child) => (wanted.includes(child) ? (known.shift() ?? child) : child));
}

/** Makes drafts of the children that a side does not have. */
function keepChildren(draft: Draft<Diagram>, id: NodeId, wanted: readonly unknown[]): void {
  for (const child of [...(nodeOf(draft, id).children ?? [])]) {
    if (!wanted.includes(child)) moveNode(child, { at: 'draft' })(draft);
  }
}

function take(draft: Draft<Diagram>, conflict: Conflict, side: Side): void {
  const { op, node, field } = conflict;
  const value = conflict[side];
  if (node !== '' && !draft.nodes[node]) return;
  if (op === 'delete' && value === null && node !== '') {
    removeSubtrees([node])(draft);
    return;
  }
  if (op === 'children' && Array.isArray(value)) keepChildren(draft, node, value);
  if (side === 'ours') return;
  if (op === 'change' || op === 'rename') {
    const target = node === '' ? draft : nodeOf(draft, node);
    setIn(target as unknown as Rows, op === 'rename' ? 'name' : field, value);
  } else if (op === 'reorder' && Array.isArray(value)) {
    order(draft, node, value);
  } else if (op === 'root' && text(value) in draft.nodes) {
    moveNode(text(value), { at: 'root' })(draft);
  } else if (op === 'move' || op === 'ring') {
    const place = placeOf(value);
    if (place) move(draft, node, place);
  }
}

/** Decides one conflict: brings a side into the tree, and takes the entry out of the list. */
export function decide(index: number, side: Side): Recipe {
  return (draft) => {
    const plain = asPlain(draft);
    const conflict = conflictsOf(plain)[index];
    if (!conflict) return;
    take(draft, conflict, side);
    const own = ownEntries(plain);
    if (index < own.length) {
      const left = own.filter((_, place) => place !== index);
      if (left.length > 0) draft.conflicts = left;
      else delete draft.conflicts;
      return;
    }
    const left = importedEntries(plain).filter((_, place) => place !== index - own.length);
    const written = left.length > 0 ? JSON.stringify(left) : null;
    setIn(draft as unknown as Rows, `attributes.${ATTRIBUTE}`, written);
  };
}
