import { childrenOf, subtreeOf, type Diagram, type NodeId } from './diagram';
import { visibleChildren, type Box, type Layout } from './layout';
import { hasRoom } from './rules';
import type { Vocabulary } from './vocabulary';

/** A place under a parent where a dragged block may be dropped, and the mark that shows it. */
export interface Slot {
  readonly parent: NodeId;
  /** The index among the children before the drop. */
  readonly index: number;
  /** `between`: a bar between siblings; `onto`: the parent itself is marked. */
  readonly kind: 'between' | 'onto';
  readonly mark: Box;
}

const REACH = { along: 48, across: 30, below: 84, beside: 12 } as const;

const transposed = (box: Box): Box => ({ x: box.y, y: box.x, width: box.height, height: box.width });

interface Query {
  readonly diagram: Diagram;
  readonly layout: Layout;
  readonly vocabulary: Vocabulary;
  /** The blocks that are dragged, each with its subtree; absent for a new block. */
  readonly moving?: readonly NodeId[] | undefined;
}

/**
 * The tree in which slots are searched, as a top-down layout; for a left-right layout, the axes are
 * exchanged.
 */
interface Field {
  readonly boxOf: (id: NodeId) => Box | undefined;
  readonly accepts: (id: NodeId) => boolean;
  /** The widths of the columns of stacked leaves. */
  readonly columns: ReadonlyMap<NodeId, number>;
  readonly siblings: (id: NodeId) => readonly NodeId[];
  readonly parentOf: ReadonlyMap<NodeId, NodeId>;
  readonly ids: readonly NodeId[];
  readonly rows: readonly Row[];
  readonly diagram: Diagram;
}

/** The children of one parent, with a margin around them for imprecise drops. */
interface Row {
  readonly parent: NodeId;
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** Returns whether a point is in a block's column of stacked leaves. */
function isInColumn(field: Field, id: NodeId | undefined, x: number): boolean {
  const box = field.boxOf(id ?? '');
  const width = field.columns.get(id ?? '');
  return !!box && width !== undefined && Math.abs(x - middleOf(box)) <= width / 2 + REACH.beside;
}

function indexAt(field: Field, siblings: readonly NodeId[], x: number, y: number): number {
  const before = siblings.filter((id) => {
    const box = field.boxOf(id);
    if (!box) return false;
    return isInColumn(field, id, x) ? box.y + box.height / 2 < y : middleOf(box) < x;
  });
  return before.length;
}

/** Returns the bar between two siblings beside each other; at an end of the row, one of them is absent. */
function barBetween(left: Box | undefined, right: Box | undefined): Box | null {
  const tops = [left, right].filter((box) => box !== undefined);
  if (tops.length === 0) return null;
  const at =
    left && right
      ? (left.x + left.width + right.x) / 2
      : left
        ? left.x + left.width + REACH.beside
        : (right?.x ?? 0) - REACH.beside;
  const y = Math.min(...tops.map((box) => box.y)) - 4;
  const bottom = Math.max(...tops.map((box) => box.y + box.height)) + 4;
  return { x: at - 2, y, width: 4, height: bottom - y };
}

/** Returns the bar between two leaves below each other; at an end of the column, one of them is absent. */
function barBelow(upper: Box | undefined, lower: Box | undefined): Box | null {
  const bar = barBetween(upper && transposed(upper), lower && transposed(lower));
  return bar && transposed(bar);
}

function slotBetween(field: Field, parent: NodeId, x: number, y: number): Slot | null {
  const siblings = field.siblings(parent);
  const index = indexAt(field, siblings, x, y);
  const [before, next] = [siblings[index - 1], siblings[index]];
  const inColumn = (id: NodeId | undefined): Box | undefined =>
    isInColumn(field, id, x) ? field.boxOf(id ?? '') : undefined;
  const mark =
    barBelow(inColumn(before), inColumn(next)) ??
    barBetween(field.boxOf(before ?? ''), field.boxOf(next ?? ''));
  if (!mark) return null;
  // The index must count all children, since the visible siblings lack the moved block.
  const all = childrenOf(field.diagram, parent);
  return { parent, index: next === undefined ? all.length : all.indexOf(next), kind: 'between', mark };
}

function slotOnto(field: Field, parent: NodeId): Slot | null {
  const box = field.boxOf(parent);
  if (!box || !field.accepts(parent)) return null;
  return { parent, index: childrenOf(field.diagram, parent).length, kind: 'onto', mark: box };
}

const inside = (box: Box, x: number, y: number): boolean =>
  x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;

/** Returns the slot on a block: its middle means as a child, its sides mean beside it. */
function slotOnBlock(
  field: Field,
  id: NodeId,
  parent: NodeId | undefined,
  x: number,
  y: number,
): Slot | null {
  const box = field.boxOf(id);
  if (!box) return null;
  const side = field.columns.has(id)
    ? Math.abs(y - (box.y + box.height / 2)) > box.height / 4
    : Math.abs(x - (box.x + box.width / 2)) > box.width / 4;
  const beside = parent !== undefined && field.accepts(parent) ? slotBetween(field, parent, x, y) : null;
  const onto = slotOnto(field, id);
  return side ? (beside ?? onto) : (onto ?? beside);
}

const middleOf = (box: Box): number => box.x + box.width / 2;

/**
 * Returns the width of the column for each stacked child of a parent; the leaves of a column follow each
 * other.
 */
function columnsOf(ids: readonly NodeId[], boxOf: Field['boxOf']): [NodeId, number][] {
  const columns: { readonly ids: NodeId[]; readonly middle: number; width: number }[] = [];
  for (const id of ids) {
    const box = boxOf(id);
    if (!box) continue;
    const last = columns.at(-1);
    if (last && Math.abs(last.middle - middleOf(box)) <= 1) {
      last.ids.push(id);
      last.width = Math.max(last.width, box.width);
    } else columns.push({ ids: [id], middle: middleOf(box), width: box.width });
  }
  return columns.flatMap(({ ids: column, width }) => column.map((id): [NodeId, number] => [id, width]));
}

function rowOf(parent: NodeId, boxes: readonly Box[], isStacked: boolean): Row {
  return {
    parent,
    left: Math.min(...boxes.map((box) => box.x)) - REACH.along,
    right: Math.max(...boxes.map((box) => box.x + box.width)) + REACH.along,
    top: Math.min(...boxes.map((box) => box.y)) - REACH.across,
    bottom:
      Math.max(...boxes.map((box) => box.y + (isStacked ? box.height : Math.min(box.height, 60)))) +
      REACH.across,
  };
}

function rowDistance({ left, right, top, bottom }: Row, x: number, y: number): number {
  if (x < left || x > right || y < top || y > bottom) return Infinity;
  return Math.abs(y - (top + bottom) / 2);
}

function findSlot(field: Field, x: number, y: number): Slot | null {
  for (const id of field.ids) {
    const box = field.boxOf(id);
    if (box && inside(box, x, y)) {
      return slotOnBlock(field, id, field.parentOf.get(id), x, y);
    }
  }
  let best: NodeId | null = null;
  let distance = Infinity;
  for (const row of field.rows) {
    const found = rowDistance(row, x, y);
    if (found < distance && field.accepts(row.parent)) [best, distance] = [row.parent, found];
  }
  if (best !== null) return slotBetween(field, best, x, y);
  for (const id of field.ids) {
    const box = field.boxOf(id);
    if (!box || field.siblings(id).length > 0) continue;
    if (inside({ ...box, height: box.height + REACH.below }, x, y)) return slotOnto(field, id);
  }
  return null;
}

function fieldOf({ diagram, layout, vocabulary, moving = [] }: Query): Field {
  const hidden = new Set(moving.flatMap((top) => subtreeOf(diagram, top)));
  const leaving = new Set(moving);
  const ids = Object.keys(layout.positions).filter((id) => id in diagram.nodes && !hidden.has(id));
  const boxOf = (id: NodeId): Box | undefined => {
    const box = layout.positions[id];
    return box && (diagram.layout === 'vertical' ? box : transposed(box));
  };
  const siblings = (id: NodeId): readonly NodeId[] => {
    const children = visibleChildren(diagram, id);
    return children.some((child) => hidden.has(child))
      ? children.filter((child) => !hidden.has(child))
      : children;
  };
  const parentOf = new Map(ids.flatMap((id) => siblings(id).map((child) => [child, id] as const)));
  const { stacked } = layout;
  const columns = new Map(
    stacked
      ? ids.flatMap((id) =>
          columnsOf(
            siblings(id).filter((each) => stacked.has(each)),
            boxOf,
          ),
        )
      : [],
  );
  const rows = ids.flatMap((id) => {
    const boxes = siblings(id)
      .map(boxOf)
      .filter((box) => box !== undefined);
    return boxes.length > 0
      ? [
          rowOf(
            id,
            boxes,
            siblings(id).some((each) => columns.has(each)),
          ),
        ]
      : [];
  });
  const accepts = (id: NodeId) => hasRoom(diagram, id, vocabulary, Math.max(1, moving.length), leaving);
  return { boxOf, siblings, parentOf, diagram, accepts, columns, ids, rows };
}

/** Finds the slot at a point; null if there is none. */
export type SlotFinder = (x: number, y: number) => Slot | null;

/** Prepares the search of slots in a tree once, for all moves of a drag. */
export function slotFinder(query: Query): SlotFinder {
  const field = fieldOf(query);
  if (query.diagram.layout === 'vertical') return (x, y) => findSlot(field, x, y);
  return (x, y) => {
    const slot = findSlot(field, y, x);
    return slot && { ...slot, mark: transposed(slot.mark) };
  };
}

/** Returns whether the blocks would stay where they are if they were dropped into the slot in this order. */
export function isSamePlace(diagram: Diagram, moving: readonly NodeId[], slot: Slot): boolean {
  const children = childrenOf(diagram, slot.parent);
  const at = children.indexOf(moving[0] ?? '');
  if (at < 0 || moving.some((id, offset) => children[at + offset] !== id)) return false;
  return slot.index >= at && slot.index <= at + moving.length;
}
