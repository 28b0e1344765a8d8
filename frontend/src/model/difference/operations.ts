import type { Diagram, NodeId } from '../diagram';
import { match } from './match';
import { fieldsOf, indexIn, parentIn, shapeOf, treeFieldsOf, type Parent, type Shape } from './shape';

interface Place {
  readonly parent: Parent;
  readonly index: number;
}

interface Called extends Place {
  readonly node: NodeId;
  readonly type: string;
  readonly name?: string;
  readonly tree?: string;
}

interface Kept {
  readonly node: NodeId;
  /** The node's id in the older version, if it is another one. */
  readonly was?: NodeId;
}

interface Texts {
  readonly before: string | null;
  readonly after: string | null;
}

/** One operation between two versions of a tree; node `''` is the tree itself. */
export type Operation =
  | ({ readonly op: 'insert' | 'delete' } & Called)
  | ({ readonly op: 'wrap' | 'unwrap'; readonly children: readonly NodeId[] } & Called)
  | ({ readonly op: 'move' | 'reorder'; readonly from: Place; readonly to: Place } & Kept)
  | ({ readonly op: 'rename' } & Texts & Kept)
  | ({ readonly op: 'change'; readonly field: string } & Texts & Kept);

type Partners = ReadonlyMap<NodeId, NodeId>;

/** Returns the nearest ancestor of each node that both versions have. */
function keptAncestors(shape: Shape, partners: Partners): Map<NodeId, Parent> {
  const found = new Map<NodeId, Parent>();
  for (const id of shape.order) {
    const parent = parentIn(shape, id);
    found.set(id, parent && !partners.has(parent) ? (found.get(parent) ?? null) : parent);
  }
  return found;
}

/** Returns, for each node that only one version has, the kept nodes (by new id) that it is put around. */
function around(shape: Shape, partners: Partners, moved: ReadonlySet<NodeId>): Map<NodeId, NodeId[]> {
  const found = new Map<NodeId, NodeId[]>();
  for (const id of shape.order) {
    const now = partners.get(id);
    if (now === undefined || moved.has(now)) continue;
    for (let up = parentIn(shape, id); up && !partners.has(up); up = parentIn(shape, up)) {
      const inside = found.get(up);
      if (inside) inside.push(now);
      else found.set(up, [now]);
    }
  }
  return found;
}

function alone(
  shape: Shape,
  id: NodeId,
  children: readonly NodeId[] | undefined,
  ops: readonly ['wrap', 'insert'] | readonly ['unwrap', 'delete'],
): Operation {
  const { type = '', name, tree } = shape.diagram.nodes[id] ?? {};
  const what = {
    node: id,
    type,
    ...(name ? { name } : {}),
    ...(tree ? { tree } : {}),
    parent: parentIn(shape, id),
    index: indexIn(shape, id),
  };
  return children ? { op: ops[0], ...what, children } : { op: ops[1], ...what };
}

function changes(
  node: NodeId,
  before: ReadonlyMap<string, string>,
  after: ReadonlyMap<string, string>,
): (Operation & { readonly op: 'change' })[] {
  return [...new Set([...before.keys(), ...after.keys()])]
    .map((field) => ({ field, before: before.get(field) ?? null, after: after.get(field) ?? null }))
    .filter((change) => change.before !== change.after)
    .map((change) => ({ op: 'change', node, ...change }));
}

/** Returns the places of a longest rising part of a list of different numbers. */
export function rising(ranks: readonly number[]): ReadonlySet<number> {
  const ends: number[] = [];
  const places: number[] = [];
  const previous: number[] = [];
  ranks.forEach((rank, place) => {
    const above = ends.findIndex((end) => end >= rank);
    const length = above < 0 ? ends.length : above;
    previous.push(places[length - 1] ?? -1);
    ends[length] = rank;
    places[length] = place;
  });
  const found = new Set<number>();
  for (let place = places.at(-1) ?? -1; place >= 0; place = previous[place] ?? -1) found.add(place);
  return found;
}

/** Returns the fewest nodes whose move among their siblings explains the new order. */
function reorderedIn(
  older: Shape,
  newer: Shape,
  back: Partners,
  above: ReadonlyMap<NodeId, Parent>,
  moved: ReadonlySet<NodeId>,
): ReadonlySet<NodeId> {
  const groups = new Map<NodeId, NodeId[]>();
  for (const id of newer.order) {
    const parent = above.get(id);
    if (!parent || !back.has(id) || moved.has(id)) continue;
    const group = groups.get(parent);
    if (group) group.push(id);
    else groups.set(parent, [id]);
  }
  const found = new Set<NodeId>();
  for (const siblings of groups.values()) {
    const steady = rising(siblings.map((id) => older.ranks.get(back.get(id) ?? '') ?? 0));
    siblings.forEach((id, place) => {
      if (!steady.has(place)) found.add(id);
    });
  }
  return found;
}

export interface Comparison {
  /** The partner in the newer version of each node that both have. */
  readonly pairs: Partners;
  readonly operations: readonly Operation[];
}

/**
 * Returns the operations that make `newer` of `older`, as `translator/difference/operations.py` does; both
 * are held to `tests/shared/differences.json`.
 */
export function compare(olderDiagram: Diagram, newerDiagram: Diagram, withLayout = false): Comparison {
  const older = shapeOf(olderDiagram);
  const newer = shapeOf(newerDiagram);
  const pairs = match(older, newer);
  const back = new Map([...pairs].map(([old, now]) => [now, old]));
  const aboveOld = keptAncestors(older, pairs);
  const aboveNew = keptAncestors(newer, back);
  const moved = new Set<NodeId>();
  for (const [old, now] of pairs) {
    const above = aboveOld.get(old);
    if ((above ? pairs.get(above) : above) !== aboveNew.get(now)) moved.add(now);
  }
  const reordered = reorderedIn(older, newer, back, aboveNew, moved);
  const operations: Operation[] = changes(
    '',
    treeFieldsOf(olderDiagram, withLayout),
    treeFieldsOf(newerDiagram, withLayout),
  );
  const same = new Map([...back.keys()].map((id) => [id, id]));
  const wrapped = around(newer, same, moved);
  for (const id of newer.order) {
    const old = back.get(id);
    if (old === undefined) {
      operations.push(alone(newer, id, wrapped.get(id), ['wrap', 'insert']));
      continue;
    }
    const before = fieldsOf(olderDiagram.nodes[old] ?? { type: '' }, withLayout);
    const after = fieldsOf(newerDiagram.nodes[id] ?? { type: '' }, withLayout);
    const names = { before: before.get('name') ?? null, after: after.get('name') ?? null };
    before.delete('name');
    after.delete('name');
    const was = old === id ? {} : { was: old };
    if (names.before !== names.after) operations.push({ op: 'rename', node: id, ...was, ...names });
    operations.push(...changes(id, before, after).map((change) => ({ ...change, ...was })));
    if (!moved.has(id) && !reordered.has(id)) continue;
    operations.push({
      op: moved.has(id) ? 'move' : 'reorder',
      node: id,
      ...was,
      from: { parent: parentIn(older, old), index: indexIn(older, old) },
      to: { parent: parentIn(newer, id), index: indexIn(newer, id) },
    });
  }
  const unwrapped = around(older, pairs, moved);
  for (const id of older.order) {
    if (!pairs.has(id)) operations.push(alone(older, id, unwrapped.get(id), ['unwrap', 'delete']));
  }
  return { pairs, operations };
}
