import { childrenOf, subtreeOf, topsOf, type Diagram, type NodeId } from './diagram';
import type { Box } from './layout';
import { strips } from './strips';

/** Where several blocks are drawn as cells of one piece, in execution order, row by row. */
export interface Piece {
  readonly box: Box;
  readonly blocks: readonly NodeId[];
  readonly columns: number;
  /** The side of a cell. */
  readonly cell: number;
}

/** A block whose name is shown, as a box around the boxes of its children or around one piece of all below it. */
export interface Part {
  readonly id: NodeId;
  readonly box: Box;
  /** The height of its name. */
  readonly title: number;
  /** 1 for the root. */
  readonly level: number;
  readonly piece: Piece | null;
}

export interface Room {
  readonly width: number;
  readonly height: number;
}

/** The levels whose names are shown wherever there is room for them. */
const LEVELS = 3;
const GAP = 3;
/** The edges of boxes around what is in them, in px. */
const PAD = { small: 2, large: 4 } as const;
/** The heights of names, in px. */
const TITLE = { small: 14, large: 20 } as const;
/** From this height on a box has a large name. */
const LARGE_FROM = 56;
/** The smallest boxes, in px: a name alone, and a name above a piece. */
const LEAST = { name: { width: 40, height: TITLE.small }, piece: { width: 40, height: 22 } } as const;
/** The same for levels that need not be shown: they are opened only where that stays calm. */
const CALM = { name: { width: 104, height: 28 }, piece: { width: 112, height: 48 } } as const;
/** Rows of boxes never fill a box to the last pixel. */
const LOST = 1.05;
const MOST_CELL = 18;
const LEAST_CELL = 1.5;

type Sizes = typeof LEAST | typeof CALM;

const areaOf = ({ width, height }: Room): number => (width + GAP) * (height + GAP);

/** Returns the area of a box with a name above an area. */
function around(area: number): number {
  const width = Math.sqrt(2 * area);
  return (width + 2 * PAD.small + GAP) * (area / Math.max(1, width) + TITLE.small + PAD.small + GAP);
}

/** Lays a tree out as nested boxes that fill a room: what comes first in execution is first, row by row. */
class Nesting {
  readonly parts: Part[] = [];
  private readonly counts = new Map<NodeId, number>();

  constructor(private readonly diagram: Diagram) {
    for (const top of topsOf(diagram)) {
      const ids = subtreeOf(diagram, top);
      for (let i = ids.length - 1; i >= 0; i -= 1) {
        const id = ids[i] ?? '';
        this.counts.set(id, 1 + this.sum(childrenOf(diagram, id), (child) => this.count(child)));
      }
    }
  }

  /** Places all tops; false if the names of so many levels have no room. */
  place({ width, height }: Room, levels: number): boolean {
    const tops = topsOf(this.diagram);
    const needed = this.sum(tops, (id) => this.need(id, levels));
    if (needed > width * height && levels > 1) return false;
    this.row(tops, { x: 0, y: 0, width, height }, 1, levels);
    return true;
  }

  private sum(ids: readonly NodeId[], of: (id: NodeId) => number): number {
    return ids.reduce((sum, id) => sum + of(id), 0);
  }

  private count(id: NodeId): number {
    return this.counts.get(id) ?? 1;
  }

  private isClosed(id: NodeId): boolean {
    return this.diagram.nodes[id]?.collapsed === true;
  }

  /** Returns the area that the names of so many levels take, from a block on. */
  private need(id: NodeId, levels: number, sizes: Sizes = LEAST): number {
    const children = childrenOf(this.diagram, id);
    if (children.length === 0) return areaOf(sizes.name);
    if (levels <= 1 || this.isClosed(id)) return areaOf(sizes.piece);
    return around(LOST * this.sum(children, (child) => this.need(child, levels - 1, sizes)));
  }

  /** Returns the height that these names take below each other. */
  private tall(id: NodeId, levels: number): number {
    const children = childrenOf(this.diagram, id);
    if (children.length === 0) return LEAST.name.height;
    if (levels <= 1 || this.isClosed(id)) return LEAST.piece.height;
    return TITLE.small + PAD.small + Math.max(...children.map((child) => this.tall(child, levels - 1)));
  }

  /** Places siblings: each has the area that its names need, and of the rest its share of the blocks. */
  private row(ids: readonly NodeId[], box: Box, level: number, levels: number): void {
    const needs = ids.map((id) => this.need(id, levels));
    const blocks = this.sum(ids, (id) => this.count(id));
    const spare = Math.max(0, box.width * box.height - needs.reduce((sum, each) => sum + each, 0));
    const weights = ids.map((id, i) => (needs[i] ?? 0) + (spare * this.count(id)) / blocks);
    const height = Math.max(...ids.map((id) => this.tall(id, levels)));
    const boxes = strips(weights, box, { width: LEAST.name.width, height }, GAP);
    ids.forEach((id, i) => this.part(id, boxes[i] ?? box, level, levels));
  }

  private part(id: NodeId, box: Box, level: number, levels: number): void {
    const size = box.height >= LARGE_FROM ? 'large' : 'small';
    const [title, pad] = [TITLE[size], PAD[size]];
    const children = childrenOf(this.diagram, id);
    const inner: Box = {
      x: box.x + pad,
      y: box.y + title,
      width: Math.max(0, box.width - 2 * pad),
      height: Math.max(0, box.height - title - pad),
    };
    const isOpen = children.length > 0 && !this.isClosed(id) && (levels > 1 || this.isCalm(children, inner));
    const isPiece = children.length > 0 && !isOpen;
    const piece = isPiece ? pieceOf(subtreeOf(this.diagram, id).slice(1), inner) : null;
    this.parts.push({ id, box, title, level, piece });
    if (isOpen) this.row(children, inner, level + 1, Math.max(1, levels - 1));
  }

  /** Whether another level can be opened without a crowd of names. */
  private isCalm(children: readonly NodeId[], { width, height }: Box): boolean {
    const needed = LOST * this.sum(children, (id) => this.need(id, 1, CALM));
    return needed <= width * height && width >= CALM.name.width && height >= CALM.name.height;
  }
}

function pieceOf(blocks: readonly NodeId[], box: Box): Piece {
  const fits = (cell: number): boolean =>
    Math.floor(box.width / cell) * Math.floor(box.height / cell) >= blocks.length;
  let cell = MOST_CELL;
  while (cell > LEAST_CELL && !fits(cell)) cell -= 0.5;
  return { box, blocks, cell, columns: Math.max(1, Math.floor(box.width / cell)) };
}

/**
 * Returns the whole tree as nested boxes in a room. The names of the upper three levels are shown if all of them
 * have room, otherwise those of fewer levels; deeper ones where that stays calm. Parents come before children.
 */
export function nestTree(diagram: Diagram, room: Room): readonly Part[] {
  if (room.width <= 0 || room.height <= 0) return [];
  const nesting = new Nesting(diagram);
  for (let levels = LEVELS; levels > 0; levels -= 1) if (nesting.place(room, levels)) break;
  return nesting.parts;
}

/** Returns the box of a block in a piece. */
export function cellOf({ box, columns, cell }: Piece, index: number): Box {
  const [column, row] = [index % columns, Math.floor(index / columns)];
  return { x: box.x + column * cell, y: box.y + row * cell, width: cell, height: cell };
}

/** Returns the block of a piece at a point; undefined beside its cells. */
export function blockAt({ box, columns, cell, blocks }: Piece, x: number, y: number): NodeId | undefined {
  const [column, row] = [Math.floor((x - box.x) / cell), Math.floor((y - box.y) / cell)];
  return column < 0 || column >= columns || row < 0 ? undefined : blocks[row * columns + column];
}
