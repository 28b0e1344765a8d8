import { describe, expect, it, vi } from 'vitest';
import { outcome } from '../../../harness/evaluations';
import { CELL_PX, cellAfter, cellAt, cellsOf, columnsOf, draw, heightOf } from './cells';

describe('cells', () => {
  it('are large enough to be pressed', () => {
    expect(CELL_PX).toBeGreaterThanOrEqual(24 + 2);
  });

  it('fill the width in rows', () => {
    expect(columnsOf(10 * CELL_PX + 3)).toBe(10);
    expect(columnsOf(0)).toBe(1);
    expect(heightOf(21, 10)).toBe(3 * CELL_PX);
  });

  it('are as many as are wanted, and reach to the last outcome, however many there are', () => {
    expect(cellsOf(4, 10, [])).toBe(4);
    expect(cellsOf(4, 10, [10, 15])).toBe(6);
    const seeds = Array.from({ length: 200_000 }, (_, index) => index);
    expect(cellsOf(0, 0, seeds)).toBe(200_000);
  });

  it('are found by their place', () => {
    expect(cellAt(CELL_PX * 2 + 1, CELL_PX + 1, 10, 20)).toBe(12);
    expect(cellAt(CELL_PX * 11, 1, 10, 20)).toBeNull();
    expect(cellAt(1, CELL_PX * 2 + 1, 10, 20)).toBeNull();
  });

  it.each([
    ['ArrowRight', 5, 6],
    ['ArrowLeft', 0, 0],
    ['ArrowDown', 5, 15],
    ['ArrowDown', 18, 19],
    ['ArrowUp', 15, 5],
    ['Home', 15, 0],
    ['End', 3, 19],
    ['x', 3, null],
  ])('lead with %s from %i to %s', (key, from, to) => {
    expect(cellAfter(key, from, 10, 20)).toBe(to);
  });

  it('are drawn by outcome, and 2,000 of them with few calls each', () => {
    const context = { fillRect: vi.fn(), strokeRect: vi.fn(), fillStyle: '', strokeStyle: '', lineWidth: 1 };
    const outcomeAt = (index: number) => outcome(index, { outcome: index % 2 ? 'failure' : 'success' });
    draw(
      context as unknown as CanvasRenderingContext2D,
      { cells: 2000, columns: 50, outcomeAt, chosen: 3, isMarked: (index) => index === 4 },
      (token) => token,
    );
    expect(context.fillRect).toHaveBeenCalledTimes(3000);
    expect(context.strokeRect).toHaveBeenCalledTimes(2);
  });
});
