import type { NodeId } from '../diagram';
import { below, branchOf, fieldsOf, parentIn, ROOT, type Shape } from './shape';

/** The matched branches below a node from which partners for it are searched, and the levels above each. */
const LOOKED_AT = 100;
const CLIMBED = 8;

type Numbers = Map<NodeId, number>;
type Kind = 'branches' | 'names' | 'types' | 'paths';

/** Numbers equal things of both versions. */
interface Kinds extends Readonly<Record<Kind, Numbers>> {
  readonly heights: Numbers;
}

function kindsOf(shape: Shape, known: Map<string, number>): Kinds {
  const number = (...parts: readonly unknown[]): number => {
    const key = JSON.stringify(parts);
    const found = known.get(key) ?? known.size;
    known.set(key, found);
    return found;
  };
  const kinds: Kinds = {
    branches: new Map(),
    heights: new Map(),
    names: new Map(),
    types: new Map(),
    paths: new Map(),
  };
  const { nodes } = shape.diagram;
  for (const id of [...shape.order].reverse()) {
    const node = nodes[id] ?? { type: '' };
    const children = below(shape, id);
    const inside = children.map((child) => kinds.branches.get(child));
    kinds.branches.set(id, number('branch', [...fieldsOf(node)], inside));
    kinds.heights.set(id, 1 + Math.max(0, ...children.map((child) => kinds.heights.get(child) ?? 0)));
    kinds.types.set(id, number('type', node.type));
    kinds.names.set(id, number('name', node.type, node.name ?? null, node.tree ?? ''));
  }
  for (const id of shape.order) {
    const parent = parentIn(shape, id);
    const [above, name] = parent ? [kinds.paths.get(parent), kinds.names.get(parent)] : [-1, -1];
    kinds.paths.set(id, number('path', above, name));
  }
  return kinds;
}

/** Returns pairs of one kind: the first with the first, the second with the second. */
function zipped(older: readonly NodeId[], newer: readonly NodeId[], one: Numbers, other: Numbers) {
  const waiting = new Map<number | undefined, NodeId[]>();
  for (const id of newer) {
    const list = waiting.get(other.get(id));
    if (list) list.push(id);
    else waiting.set(other.get(id), [id]);
  }
  const pairs: [NodeId, NodeId][] = [];
  for (const id of older) {
    const partner = waiting.get(one.get(id))?.shift();
    if (partner !== undefined) pairs.push([id, partner]);
  }
  return pairs;
}

class Matching {
  readonly back: Map<NodeId, NodeId>;
  private readonly oldKinds: Kinds;
  private readonly newKinds: Kinds;

  constructor(
    private readonly older: Shape,
    private readonly newer: Shape,
    readonly pairs: Map<NodeId, NodeId>,
  ) {
    this.back = new Map([...pairs].map(([old, now]) => [now, old]));
    const known = new Map<string, number>();
    this.oldKinds = kindsOf(older, known);
    this.newKinds = kindsOf(newer, known);
  }

  private pair(old: NodeId, now: NodeId): void {
    if (this.pairs.has(old) || this.back.has(now)) return;
    this.pairs.set(old, now);
    this.back.set(now, old);
  }

  private free(old: readonly NodeId[], now: readonly NodeId[]): [NodeId[], NodeId[]] {
    return [old.filter((id) => !this.pairs.has(id)), now.filter((id) => !this.back.has(id))];
  }

  /** Pairs equal branches with at least so many levels, the highest first; a leaf only if it is unique. */
  equalBranches(least: number): void {
    const [old, now] = this.free(this.older.order, this.newer.order);
    const groups = new Map<number, [NodeId[], NodeId[]]>();
    const sides = [
      [old, this.oldKinds],
      [now, this.newKinds],
    ] as const;
    sides.forEach(([ids, kinds], side) => {
      for (const id of ids) {
        if ((kinds.heights.get(id) ?? 0) < least) continue;
        const branch = kinds.branches.get(id) ?? 0;
        const group = groups.get(branch) ?? [[], []];
        groups.set(branch, group);
        group[side]?.push(id);
      }
    });
    const height = (ids: readonly NodeId[]) => this.oldKinds.heights.get(ids[0] ?? '') ?? 0;
    const rank = (ids: readonly NodeId[]) => this.older.ranks.get(ids[0] ?? '') ?? 0;
    const both = [...groups.values()].filter(([one, other]) => one.length > 0 && other.length > 0);
    both.sort(([a], [b]) => height(b) - height(a) || rank(a) - rank(b));
    for (const [one, other] of both) {
      if (least === 1 && (one.length > 1 || other.length > 1)) continue;
      // Those at one place first.
      for (const kind of ['paths', 'branches'] as const) {
        const [a, b] = this.free(one, other);
        for (const [top, partner] of zipped(a, b, this.oldKinds[kind], this.newKinds[kind])) {
          const inside = branchOf(this.newer, partner);
          branchOf(this.older, top).forEach((id, place) => this.pair(id, inside[place] ?? ''));
        }
      }
    }
  }

  /** Pairs nodes of a type of which more than half of the descendants are partners. */
  similarBranches(): void {
    for (const old of [...this.older.order].reverse()) {
      if (this.pairs.has(old) || below(this.older, old).length === 0) continue;
      const ranks = branchOf(this.older, old)
        .flatMap((id) => this.newer.ranks.get(this.pairs.get(id) ?? '') ?? [])
        .sort((a, b) => a - b);
      const best = ranks.length > 0 ? this.best(old, ranks) : null;
      if (best !== null) this.pair(old, best);
    }
  }

  private best(old: NodeId, ranks: readonly number[]): NodeId | null {
    const { nodes } = this.newer.diagram;
    const type = this.older.diagram.nodes[old]?.type;
    const size = this.older.sizes.get(old) ?? 0;
    const found = new Map<NodeId, number>();
    for (const start of this.frontier(old)) {
      let parent = parentIn(this.newer, this.pairs.get(start) ?? '');
      for (let level = 0; level < CLIMBED && parent; level += 1) {
        if (!found.has(parent) && !this.back.has(parent) && nodes[parent]?.type === type) {
          const first = this.newer.ranks.get(parent) ?? 0;
          const wide = this.newer.sizes.get(parent) ?? 0;
          const common = ranks.filter((rank) => rank >= first && rank < first + wide).length;
          found.set(parent, (2 * common) / (size + wide - 2));
        }
        parent = parentIn(this.newer, parent);
      }
    }
    const rank = (id: NodeId) => this.newer.ranks.get(id) ?? 0;
    const good = [...found].filter(([, dice]) => dice > 0.5);
    good.sort(([a, one], [b, other]) => other - one || rank(a) - rank(b));
    return good[0]?.[0] ?? null;
  }

  private frontier(old: NodeId): NodeId[] {
    const found: NodeId[] = [];
    const open = [...below(this.older, old)].reverse();
    for (let id = open.pop(); id !== undefined && found.length < LOOKED_AT; id = open.pop()) {
      if (this.pairs.has(id)) found.push(id);
      else open.push(...[...below(this.older, id)].reverse());
    }
    return found;
  }

  /** Pairs the roots, if they are of one type. */
  roots(): void {
    const [old] = below(this.older, ROOT);
    const [now] = below(this.newer, ROOT);
    if (old === undefined || now === undefined) return;
    if (this.older.diagram.nodes[old]?.type === this.newer.diagram.nodes[now]?.type) this.pair(old, now);
  }

  /** Pairs the children of partners: equal branches, then nodes of one name, then of one type. */
  children(): void {
    for (const old of this.older.order) {
      const now = this.pairs.get(old);
      if (now === undefined) continue;
      for (const kind of ['branches', 'names', 'types'] as const) {
        const [one, other] = this.free(below(this.older, old), below(this.newer, now));
        if (one.length === 0 || other.length === 0) break;
        for (const [a, b] of zipped(one, other, this.oldKinds[kind], this.newKinds[kind])) this.pair(a, b);
      }
    }
  }
}

/**
 * Returns the partner in `newer` of each node of `older` that has one: by id, else by the two phases of
 * GumTree, as `translator/difference/match.py` does.
 */
export function match(older: Shape, newer: Shape): ReadonlyMap<NodeId, NodeId> {
  const known = older.order.filter((id) => Object.hasOwn(newer.diagram.nodes, id));
  const pairs = new Map(known.map((id) => [id, id]));
  if (pairs.size === Math.min(older.order.length, newer.order.length)) return pairs;
  const matching = new Matching(older, newer, pairs);
  matching.equalBranches(2);
  matching.similarBranches();
  matching.roots();
  matching.children();
  matching.equalBranches(1);
  return pairs;
}
