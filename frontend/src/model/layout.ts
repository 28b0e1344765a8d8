import { childrenOf, topsOf, type Diagram, type NodeId, type Orientation } from './diagram';
import { measureNode, type Size } from './measure';
import { tidyTree, type Spot } from './tidy';
import { specOf, type Vocabulary } from './vocabulary';

export interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

export interface Layout {
  readonly positions: Readonly<Record<NodeId, Box>>;
  readonly width: number;
  readonly height: number;
  /** The leaves that a compact layout draws below each other. */
  readonly stacked?: ReadonlySet<NodeId>;
}

export interface LayoutOptions {
  readonly orientation?: Orientation;
  /** Whether to ignore manual positions, as after `tidy`. */
  readonly ignorePositions?: boolean;
  /** Whether to draw neighbouring leaves below each other, which makes wide trees narrower. */
  readonly isCompact?: boolean;
}

export const GAP = { siblings: 24, levels: 56, trees: 64, stacked: 14 } as const;

/** The number of leaves in a column: fewer stay side by side, more are divided into several columns. */
const STACK = { least: 3, most: 12 } as const;

type Mutable = { -readonly [K in keyof Box]: Box[K] };

/** Returns the children that are drawn; a folded block has none. */
export function visibleChildren(diagram: Diagram, id: NodeId): readonly NodeId[] {
  return diagram.nodes[id]?.collapsed ? [] : childrenOf(diagram, id);
}

/**
 * Returns the children of a node in groups, each of which is drawn as one column; most groups have one child.
 */
function stacksOf(diagram: Diagram, id: NodeId, isStackable: (id: NodeId) => boolean): NodeId[][] {
  const stacks: NodeId[][] = [];
  let run: NodeId[] = [];
  const close = (): void => {
    const columns = Math.ceil(run.length / STACK.most);
    const size = run.length < STACK.least ? 1 : Math.ceil(run.length / columns);
    for (let at = 0; at < run.length; at += size) stacks.push(run.slice(at, at + size));
    run = [];
  };
  for (const child of visibleChildren(diagram, id)) {
    if (isStackable(child)) run.push(child);
    else {
      close();
      stacks.push([child]);
    }
  }
  close();
  return stacks;
}

/** A node of the drawing: one block, or a column of leaves. */
interface Stack {
  readonly ids: readonly NodeId[];
}

/**
 * Lays out one tree with its root's top left corner at the origin, and parents centred over their children.
 */
function arrange(
  diagram: Diagram,
  top: NodeId,
  orientation: Orientation,
  sizeOf: (id: NodeId) => Size,
  isStackable: (id: NodeId) => boolean,
): Map<NodeId, Mutable> {
  const vertical = orientation === 'vertical';
  const breadthOf = (id: NodeId): number => (vertical ? sizeOf(id).width : sizeOf(id).height);
  const depthOf = (id: NodeId): number => (vertical ? sizeOf(id).height : sizeOf(id).width);
  const spots: Spot<Stack>[] = [];
  const open: [ids: readonly NodeId[], parent: number][] = [[[top], -1]];
  for (let next = open.pop(); next; next = open.pop()) {
    const [ids, parent] = next;
    const breadth = Math.max(...ids.map(breadthOf));
    const depth = ids.reduce((sum, id) => sum + depthOf(id) + GAP.stacked, GAP.levels - GAP.stacked);
    const at = spots.push({ id: { ids }, parent, breadth, depth, middle: 0, start: 0 }) - 1;
    const [first = ''] = ids;
    const stacks = stacksOf(diagram, first, isStackable);
    for (let i = stacks.length - 1; i >= 0; i -= 1) open.push([stacks[i] ?? [], at]);
  }
  tidyTree(spots, GAP.siblings);
  const placed = new Map<NodeId, Mutable>();
  const corner = (spots[0]?.breadth ?? 0) / 2;
  for (const { id: stack, middle, start } of spots) {
    let below = start;
    for (const id of stack.ids) {
      const along = Math.round(middle - breadthOf(id) / 2 + corner);
      const across = Math.round(below);
      const { width, height } = sizeOf(id);
      // Each field is written out, since objects made by spreading are slow to read.
      placed.set(id, { x: vertical ? along : across, y: vertical ? across : along, width, height });
      below += depthOf(id) + GAP.stacked;
    }
  }
  return placed;
}

/** Returns a predicate for the leaves that may be drawn below each other: those without a manual position. */
function stackableIn(diagram: Diagram, options: LayoutOptions): (id: NodeId) => boolean {
  if (!options.isCompact) return () => false;
  return (id) =>
    childrenOf(diagram, id).length === 0 &&
    (options.ignorePositions === true || diagram.nodes[id]?.position === undefined);
}

/** Returns all leaves of a tree that share a column. */
function stackedIn(diagram: Diagram, isStackable: (id: NodeId) => boolean): ReadonlySet<NodeId> {
  const parents = Object.keys(diagram.nodes);
  const stacks = parents.flatMap((id) => stacksOf(diagram, id, isStackable));
  return new Set(stacks.filter((ids) => ids.length > 1).flat());
}

function shift(boxes: Iterable<Mutable>, dx: number, dy: number): void {
  for (const box of boxes) {
    box.x = Math.round(box.x + dx);
    box.y = Math.round(box.y + dy);
  }
}

/** Applies the manual positions; a block's subtree moves with it. */
function applyPositions(diagram: Diagram, top: NodeId, placed: Map<NodeId, Mutable>): void {
  const visit = (id: NodeId, dx: number, dy: number): void => {
    const box = placed.get(id);
    if (!box) return;
    const wanted = diagram.nodes[id]?.position;
    const moveX = wanted ? wanted[0] - box.x : dx;
    const moveY = wanted ? wanted[1] - box.y : dy;
    box.x += moveX;
    box.y += moveY;
    for (const child of visibleChildren(diagram, id)) visit(child, moveX, moveY);
  };
  visit(top, 0, 0);
}

function bounds(boxes: Iterable<Box>): { right: number; bottom: number; left: number; top: number } {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const box of boxes) {
    left = Math.min(left, box.x);
    top = Math.min(top, box.y);
    right = Math.max(right, box.x + box.width);
    bottom = Math.max(bottom, box.y + box.height);
  }
  return { left, top, right, bottom };
}

/**
 * Returns the positions (top left corners) and sizes of all visible blocks. Blocks without a manual position
 * never overlap; the root is at the origin, and drafts without a position are beside it.
 */
export function layoutTree(diagram: Diagram, vocabulary?: Vocabulary, options: LayoutOptions = {}): Layout {
  const orientation = options.orientation ?? diagram.layout;
  const sizes = new Map<NodeId, Size>();
  const sizeOf = (id: NodeId): Size => {
    const known = sizes.get(id);
    if (known) return known;
    const node = diagram.nodes[id] ?? { type: '' };
    const size = measureNode(node, vocabulary && specOf(vocabulary, node));
    sizes.set(id, size);
    return size;
  };
  const isStackable = stackableIn(diagram, options);
  const positions: Record<NodeId, Box> = {};
  let occupied = { left: 0, top: 0, right: -Infinity, bottom: -Infinity };
  for (const top of topsOf(diagram)) {
    const placed = arrange(diagram, top, orientation, sizeOf, isStackable);
    const fixed = !options.ignorePositions && diagram.nodes[top]?.position !== undefined;
    if (!fixed && occupied.right > -Infinity) {
      const own = bounds(placed.values());
      shift(placed.values(), occupied.right + GAP.trees - own.left, occupied.top - own.top);
    }
    if (!options.ignorePositions) applyPositions(diagram, top, placed);
    for (const [id, box] of placed) positions[id] = box;
    const own = bounds(placed.values());
    occupied = {
      left: Math.min(occupied.left, own.left),
      top: Math.min(occupied.top, own.top),
      right: Math.max(occupied.right, own.right),
      bottom: Math.max(occupied.bottom, own.bottom),
    };
  }
  const all = bounds(Object.values(positions));
  const empty = all.right === -Infinity;
  return {
    positions,
    width: empty ? 0 : all.right - all.left,
    height: empty ? 0 : all.bottom - all.top,
    ...(options.isCompact ? { stacked: stackedIn(diagram, isStackable) } : {}),
  };
}
