import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from './diagram';
import type { Box } from './layout';
import { blockAt, cellOf, nestTree, type Part } from './nested';

const ROOM = { width: 738, height: 441 };

/** A tree in which every block of a level has so many children. */
function treeOf(...children: number[]): Diagram {
  const nodes: Record<string, DiagramNode> = {};
  const grow = (id: string, [count = 0, ...rest]: number[]): string => {
    const below = Array.from({ length: count }, (_, at) => grow(`${id}.${at}`, rest));
    nodes[id] = below.length > 0 ? { type: 'Sequence', children: below } : { type: 'Sleep' };
    return id;
  };
  return { ...emptyDiagram('Main'), root: grow('r', children), nodes };
}

const levelOf = ({ id }: Part) => id.split('.').length;
const shown = (parts: readonly Part[]) =>
  parts.reduce((sum, { piece }) => sum + 1 + (piece?.blocks.length ?? 0), 0);
const isWithin = (inner: Box, outer: Box) =>
  inner.x >= outer.x - 0.01 &&
  inner.y >= outer.y - 0.01 &&
  inner.x + inner.width <= outer.x + outer.width + 0.01 &&
  inner.y + inner.height <= outer.y + outer.height + 0.01;

describe('nestTree', () => {
  it('names the upper three levels of 601 blocks, and has each other block in one piece', () => {
    const parts = nestTree(treeOf(120, 1, 3), ROOM);
    expect(parts.filter((part) => levelOf(part) <= 3)).toHaveLength(1 + 120 + 120);
    expect(shown(parts)).toBe(601);
    expect(Math.min(...parts.map(({ box }) => box.width))).toBeGreaterThanOrEqual(40);
    expect(Math.min(...parts.map(({ box, title }) => box.height - title))).toBeGreaterThanOrEqual(0);
    expect(parts.every(({ level, ...part }) => level === levelOf({ level, ...part }))).toBe(true);
  });

  it('draws boxes within the box of their parent, which comes first, and none over another', () => {
    const parts = nestTree(treeOf(4, 5, 4, 6), ROOM);
    const seen = new Map<string, Part>();
    for (const part of parts) {
      const parent = seen.get(part.id.split('.').slice(0, -1).join('.'));
      if (part.id !== 'r') expect(isWithin(part.box, parent!.box)).toBe(true);
      if (part.piece) expect(isWithin(part.piece.box, part.box)).toBe(true);
      seen.set(part.id, part);
    }
    const third = parts.filter((part) => levelOf(part) === 3).map(({ box }) => box);
    expect(third).toHaveLength(20);
    for (const [at, a] of third.entries())
      for (const b of third.slice(at + 1))
        expect(
          a.x + a.width <= b.x + 0.01 ||
            b.x + b.width <= a.x + 0.01 ||
            a.y + a.height <= b.y + 0.01 ||
            b.y + b.height <= a.y + 0.01,
        ).toBe(true);
  });

  it('gives parts an area by the number of their blocks', () => {
    const diagram = treeOf(2, 10, 5);
    const nodes = { ...diagram.nodes, 'r.0': { type: 'Sequence', children: ['r.0.0', 'r.0.1'] } };
    const parts = nestTree({ ...diagram, nodes }, ROOM);
    const area = (id: string) => {
      const { width, height } = parts.find((part) => part.id === id)!.box;
      return width * height;
    };
    expect(area('r.1') / area('r.0')).toBeGreaterThan(3);
  });

  it('names as many levels as have room', () => {
    const parts = nestTree(treeOf(600), { width: 300, height: 200 });
    expect(parts).toHaveLength(1);
    expect(parts[0]?.piece?.blocks).toHaveLength(600);
    expect(nestTree(treeOf(3), { width: 0, height: 200 })).toEqual([]);
  });

  it('opens deeper levels where that stays calm: a chain of decorators hides nothing', () => {
    const parts = nestTree(treeOf(1, 1, 1, 1, 4, 2), ROOM);
    expect(Math.max(...parts.map(levelOf))).toBeGreaterThan(5);
  });

  it('keeps a folded block closed, and counts what it hides; drafts stand beside the root', () => {
    const diagram = treeOf(2, 3, 4);
    const nodes = {
      ...diagram.nodes,
      'r.0': { ...diagram.nodes['r.0']!, collapsed: true },
      draft: { type: 'Sleep' },
    };
    const parts = nestTree({ ...diagram, nodes, drafts: ['draft'] }, ROOM);
    expect(parts.find(({ id }) => id === 'r.0')?.piece?.blocks).toHaveLength(15);
    expect(parts.some(({ id }) => id.startsWith('r.0.'))).toBe(false);
    expect(parts.find(({ id }) => id === 'draft')).toMatchObject({ level: 1, piece: null });
  });
});

describe('a piece', () => {
  it('has a cell for each block, in execution order, row by row', () => {
    const { piece } = nestTree(treeOf(600), { width: 300, height: 200 })[0]!;
    piece!.blocks.forEach((id, index) => {
      const { x, y, width, height } = cellOf(piece!, index);
      expect(blockAt(piece!, x + width / 2, y + height / 2)).toBe(id);
    });
    const last = cellOf(piece!, 599);
    expect(isWithin(last, piece!.box)).toBe(true);
    expect(blockAt(piece!, last.x + last.width * 1.5, last.y + 1)).toBeUndefined();
    expect(blockAt(piece!, piece!.box.x - 1, piece!.box.y)).toBeUndefined();
  });
});
