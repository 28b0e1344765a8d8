import { describe, expect, it } from 'vitest';
import { tidyTree, type Spot } from './tidy';

type Shape = readonly [breadth: number, ...children: Shape[]];

/** Lays out a tree whose levels are 10 deep, and returns the middles in pre-order. */
function middles(shape: Shape, gap = 2): number[] {
  const spots: Spot<number>[] = [];
  const grow = ([breadth, ...children]: Shape, parent: number): void => {
    const at = spots.push({ id: spots.length, parent, breadth, depth: 10, middle: 0, start: 0 }) - 1;
    for (const child of children) grow(child, at);
  };
  grow(shape, -1);
  tidyTree(spots, gap);
  return spots.map((spot) => spot.middle);
}

const leaf: Shape = [4];

describe('tidyTree', () => {
  it('puts a parent in the middle above its children', () => {
    expect(middles([4, leaf, leaf, leaf])).toEqual([0, -6, 0, 6]);
  });

  it('uses the sizes of the first and the last child', () => {
    const [, wide, narrow] = middles([4, [10], [2]]) as [number, number, number];
    expect(narrow - wide).toBe(10 / 2 + 2 + 2 / 2);
    expect(wide - 5).toBe(-(narrow + 1));
  });

  it('draws equal subtrees alike wherever they are', () => {
    const twins: Shape = [4, leaf, [8, leaf]];
    const [, a, a1, a2, a3, b, b1, b2, b3] = middles([4, twins, twins]) as number[];
    expect([a1! - a!, a2! - a!, a3! - a!]).toEqual([b1! - b!, b2! - b!, b3! - b!]);
  });

  it('lets a shallow child be above the wide part of a deep neighbour', () => {
    const deep: Shape = [4, [4, leaf, leaf, leaf]];
    const [, , , , , , shallow] = middles([4, deep, leaf]) as number[];
    const [, first] = middles([4, deep, leaf]) as number[];
    expect(shallow! - first!).toBe(6);
  });

  it('distributes the room between two pushing subtrees over those in between', () => {
    const broad: Shape = [4, [40]];
    const at = middles([4, broad, leaf, leaf, broad]);
    const [first, second, third, fourth] = [at[1]!, at[3]!, at[4]!, at[5]!];
    expect(fourth - first).toBe(42);
    expect([second - first, third - second, fourth - third]).toEqual([14, 14, 14]);
  });

  it('lays out a chain of ten thousand', () => {
    const spots = Array.from({ length: 10_000 }, (_, id): Spot<number> => {
      return { id, parent: id - 1, breadth: 4, depth: 10, middle: 9, start: 9 };
    });
    tidyTree(spots, 2);
    expect(spots.at(-1)).toMatchObject({ middle: 0, start: 99_990 });
  });
});
