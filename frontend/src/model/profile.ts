import type { NodeTime, TreeNode } from '@/generated/messages';

/** The time of a node, with its place in a flame graph: 0 to 1 from left to right, and its depth. */
export interface Flame {
  readonly node: TreeNode;
  readonly time: NodeTime;
  readonly from: number;
  readonly width: number;
  readonly depth: number;
}

/** Narrower ones cannot be seen. */
const NARROWEST = 0.0005;

/** Returns the nodes that took the most time of their own first. */
export const slowest = (times: readonly NodeTime[]): NodeTime[] =>
  [...times].sort((a, b) => b.self_ms - a.self_ms || a.uid - b.uid);

/** Returns the share of a node in the time of all ticks, without the nodes below it: 0 to 1. */
export const shareOf = (time: NodeTime, wholeMs: number): number =>
  wholeMs > 0 ? Math.min(1, Math.max(0, time.self_ms / wholeMs)) : 0;

/**
 * Returns the nodes as a flame graph: each is as wide as its share of the whole time, above the nodes below
 * it, which stand in the order of execution; what is free beside them is its own time. Pre-order.
 */
export function flames(tree: readonly TreeNode[], times: readonly NodeTime[]): Flame[] {
  const of = new Map(times.map((time) => [time.uid, time]));
  const places = new Map<number, { flame: Flame; next: number }>();
  const found: Flame[] = [];
  const whole = tree[0] === undefined ? 0 : (of.get(tree[0].uid)?.total_ms ?? 0);
  if (!(whole > 0)) return found;
  for (const node of tree) {
    const time = of.get(node.uid);
    const above = places.get(node.parent);
    if (!time || (node.parent !== 0 && !above)) continue;
    const from = above?.next ?? 0;
    const width = Math.min(time.total_ms / whole, 1 - from);
    if (width < NARROWEST) continue;
    const flame = { node, time, from, width, depth: above ? above.flame.depth + 1 : 0 };
    found.push(flame);
    places.set(node.uid, { flame, next: from });
    if (above) above.next = from + width;
  }
  return found;
}
