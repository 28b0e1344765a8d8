import { preorder, type Diagram, type NodeId } from '../diagram';
import { rising } from '../difference/operations';
import { fieldsOf, isSame, placesOf, TREE, type Operation, type Place } from './operation';

function sets(id: NodeId, before: object, after: object): Operation[] {
  const was = fieldsOf(before);
  const now = fieldsOf(after);
  const found: Operation[] = [];
  for (const [name, [field]] of was) {
    if (!now.has(name)) found.push({ op: 'set', id, field, value: null });
  }
  for (const [name, [field, value]] of now) {
    if (!isSame(was.get(name)?.[1], value)) found.push({ op: 'set', id, field, value });
  }
  return found;
}

/** Returns the siblings that move in a list; the others keep their order. */
function movedIn(siblings: readonly NodeId[], at: Place, before: ReadonlyMap<NodeId, Place>, ranks: Ranks) {
  const stay = siblings.filter((id) => isSame(before.get(id), at));
  const steady = rising(stay.map((id) => ranks.get(id) ?? 0));
  const kept = new Set(stay.filter((_, index) => steady.has(index)));
  return siblings.filter((id) => !kept.has(id));
}

type Ranks = ReadonlyMap<NodeId, number>;

function ranksOf(diagram: Diagram): Ranks {
  const lists = [diagram.drafts, ...Object.values(diagram.nodes).map(({ children }) => children ?? [])];
  return new Map(lists.flatMap((list) => list.map((id, rank) => [id, rank] as const)));
}

/** Returns the operations that make `after` of `before`. */
export function operationsBetween(before: Diagram, after: Diagram): Operation[] {
  const found: Operation[] = sets(TREE, before, after);
  for (const [id, { children: _, ...node }] of Object.entries(after.nodes)) {
    const was = before.nodes[id];
    if (!was) found.push({ op: 'create', id, node });
    else if (was !== after.nodes[id]) found.push(...sets(id, was, node));
  }
  const places = placesOf(before);
  const ranks = ranksOf(before);
  const placeAll = (siblings: readonly NodeId[], at: Place): void => {
    const moved = new Set(movedIn(siblings, at, places, ranks));
    siblings.forEach((id, index) => {
      if (moved.has(id)) found.push({ op: 'place', id, at, after: siblings[index - 1] ?? null });
    });
  };
  if (after.root !== null && after.root !== before.root) placeAll([after.root], 'root');
  // From the top downwards, so that no node is placed below what is still below itself.
  placeAll(after.drafts, 'draft');
  for (const parent of preorder(after)) {
    const children = after.nodes[parent]?.children ?? [];
    if (children !== before.nodes[parent]?.children) placeAll(children, { parent });
  }
  for (const id of Object.keys(before.nodes)) {
    if (!(id in after.nodes)) found.push({ op: 'remove', id });
  }
  return found;
}
