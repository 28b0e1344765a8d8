/**
 * Computes a tidy drawing of a tree whose nodes differ in size: parents are in the middle above their
 * children, equal subtrees look alike, and nodes beside each other keep a gap. It takes linear time, as in A.
 * van der Ploeg, "Drawing Non-layered Tidy Trees in Linear Time", Software: Practice and Experience 44
 * (2014).
 */

/** The size of a node: the breadth along a row of siblings, and the depth from a parent to its children. */
export interface Extent {
  readonly breadth: number;
  readonly depth: number;
}

/** A node of the tree; the layout computes its middle along the row and its start in depth. */
export interface Spot<Id> extends Extent {
  readonly id: Id;
  readonly parent: number;
  middle: number;
  start: number;
}

/** One side of a subtree from the top down, as a linked list with a step for each outermost node. */
interface Step {
  /** The position of the side, in the frame of the previous step. */
  readonly at: number;
  /** The depth where the step ends. */
  readonly end: number;
  readonly next: Step | null;
  /** The offset of the next step's frame from this one's. */
  readonly by: number;
}

/** A side in the frame of a row of siblings, whose first child has its middle at 0. */
interface Side {
  readonly step: Step;
  readonly by: number;
}

/** A row of subtrees side by side. */
interface Row {
  left: Side;
  right: Side;
  /** The depth of the row. */
  end: number;
  /** The outermost nodes on the right from the top down, each with its depth. */
  readonly reach: { readonly index: number; readonly end: number }[];
  readonly middles: number[];
  /** For each sibling, the extra offset between a subtree and the distant sibling that pushes it. */
  readonly extra: number[];
}

interface Subtree {
  readonly half: number;
  readonly left: Step;
  readonly right: Step;
  readonly end: number;
}

/** Returns `upper`, continued by `lower` below the end of `upper`. */
function extended(upper: Side, upperEnd: number, lower: Side, lowerEnd: number): Side {
  if (upperEnd >= lowerEnd) return upper;
  let tail: Step | null = lower.step;
  let by = lower.by;
  while (tail && tail.end <= upperEnd) {
    by += tail.by;
    tail = tail.next;
  }
  const ats: number[] = [];
  const ends: number[] = [];
  let frame = upper.by;
  for (let step: Step | null = upper.step; step; step = step.next) {
    ats.push(frame + step.at);
    ends.push(step.end);
    frame += step.by;
  }
  let step = tail;
  for (let i = ats.length - 1; i >= 0; i -= 1) {
    step = { at: ats[i] ?? 0, end: ends[i] ?? 0, next: step, by };
    by = 0;
  }
  return step ? { step, by: 0 } : upper;
}

/** Spreads an offset over the siblings between the pushing and the pushed subtree. */
function spread({ extra }: Row, from: number, to: number, push: number): void {
  for (let i = from + 1; i < to; i += 1) {
    extra[i] = (extra[i] ?? 0) + (push * (i - from)) / (to - from);
  }
}

/** Adds a subtree to the right of a row, as near as the gap allows at every depth. */
function add(row: Row, subtree: Subtree, gap: number): void {
  const index = row.middles.length;
  let right: Step | null = row.right.step;
  let rightFrame = row.right.by;
  let left: Step | null = subtree.left;
  let leftFrame = 0;
  let middle = -Infinity;
  let start = -Infinity;
  while (right && left) {
    const wanted = rightFrame + right.at - (leftFrame + left.at) + gap;
    if (wanted > middle) {
      const pusher = row.reach.findLast((each) => each.end > start)?.index ?? index - 1;
      if (middle > -Infinity) spread(row, pusher, index, wanted - middle);
      middle = wanted;
    }
    start = Math.min(right.end, left.end);
    const [rightEnd, leftEnd] = [right.end, left.end];
    if (rightEnd <= leftEnd) {
      rightFrame += right.by;
      right = right.next;
    }
    if (leftEnd <= rightEnd) {
      leftFrame += left.by;
      left = left.next;
    }
  }
  row.middles.push(middle);
  row.extra.push(0);
  const own = { left: { step: subtree.left, by: middle }, right: { step: subtree.right, by: middle } };
  row.left = extended(row.left, row.end, own.left, subtree.end);
  row.right = extended(own.right, subtree.end, row.right, row.end);
  row.end = Math.max(row.end, subtree.end);
  while ((row.reach.at(-1)?.end ?? Infinity) <= subtree.end) row.reach.pop();
  row.reach.push({ index, end: subtree.end });
}

function rowOf({ left, right, end }: Subtree): Row {
  return {
    left: { step: left, by: 0 },
    right: { step: right, by: 0 },
    end,
    reach: [{ index: 0, end }],
    middles: [0],
    extra: [0],
  };
}

/**
 * Lays out a tree. In `spots` every parent comes before its children, and siblings are in order; the first is
 * the root, with its middle at 0.
 */
export function tidyTree<Id>(spots: readonly Spot<Id>[], gap: number): void {
  const children: number[][] = spots.map(() => []);
  spots.forEach((spot, index) => {
    const parent = spots[spot.parent];
    spot.start = parent ? parent.start + parent.depth : 0;
    children[spot.parent]?.push(index);
  });
  const subtrees: Subtree[] = [];
  for (let at = spots.length - 1; at >= 0; at -= 1) {
    const spot = spots[at];
    if (spot) subtrees[at] = subtreeOf(spot, children[at] ?? [], spots, subtrees, gap);
  }
  spots.forEach((spot, index) => {
    spot.middle = index === 0 ? 0 : spot.middle + (spots[spot.parent]?.middle ?? 0);
  });
}

/** Arranges the children of a node in a row, relative to the node's middle. */
function subtreeOf<Id>(
  spot: Spot<Id>,
  children: readonly number[],
  spots: readonly Spot<Id>[],
  subtrees: readonly Subtree[],
  gap: number,
): Subtree {
  const half = spot.breadth / 2;
  const end = spot.start + spot.depth;
  const [first, ...others] = children.flatMap((child) => subtrees[child] ?? []);
  if (!first) {
    return {
      half,
      left: { at: -half, end, next: null, by: 0 },
      right: { at: half, end, next: null, by: 0 },
      end,
    };
  }
  const row = rowOf(first);
  for (const other of others) add(row, other, gap);
  const last = others.at(-1) ?? first;
  const middle = ((row.middles.at(-1) ?? 0) + last.half - first.half) / 2;
  children.forEach((child, index) => {
    const placed = spots[child];
    if (placed) placed.middle = (row.middles[index] ?? 0) + (row.extra[index] ?? 0) - middle;
  });
  return {
    half,
    left: { at: -half, end, next: row.left.step, by: row.left.by - middle },
    right: { at: half, end, next: row.right.step, by: row.right.by - middle },
    end: Math.max(end, row.end),
  };
}
