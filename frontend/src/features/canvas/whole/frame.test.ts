import { expect, it } from 'vitest';
import type { Part, Piece } from '@/model/nested';
import { boxOf, frameOf, partAt } from './frame';

const piece = (cell: number): Piece => ({
  box: { x: 14, y: 30, width: 40, height: 40 },
  blocks: ['a', 'b'],
  columns: 2,
  cell,
});
const parts = (cell: number): Part[] => [
  { id: 'r', box: { x: 0, y: 0, width: 200, height: 100 }, title: 20, level: 1, piece: null },
  { id: 's', box: { x: 10, y: 20, width: 60, height: 60 }, title: 10, level: 2, piece: piece(cell) },
];

it('leaves room for breadcrumbs and tools, also on a small canvas', () => {
  const { x, y, width, height } = frameOf(800, 600);
  expect([x + width, y > 40, y + height < 600 - 50]).toEqual([788, true, true]);
  expect(frameOf(10, 10)).toMatchObject({ width: 0, height: 0 });
});

it('finds the innermost box, or the cell that is aimed at', () => {
  expect(partAt(parts(10), 5, 5)).toBe('r');
  expect(partAt(parts(10), 12, 22)).toBe('s');
  expect(partAt(parts(10), 16, 32)).toBe('a');
  expect(partAt(parts(10), 26, 32)).toBe('b');
  expect(partAt(parts(10), 16, 60)).toBe('s');
  expect(partAt(parts(10), 500, 5)).toBeNull();
});

it('takes cells that are too small to be aimed at for their piece', () => {
  expect(partAt(parts(3), 15, 31)).toBe('s');
});

it('knows the place of the name or of the cell of a block', () => {
  expect(boxOf(parts(10), 's')).toEqual({ x: 10, y: 20, width: 60, height: 10 });
  expect(boxOf(parts(10), 'b')).toEqual({ x: 24, y: 30, width: 10, height: 10 });
  expect(boxOf(parts(10), 'gone')).toBeNull();
});
