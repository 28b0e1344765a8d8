import { expect, it } from 'vitest';
import { strips } from './strips';

const LEAST = { width: 40, height: 14 };
const BOX = { x: 10, y: 20, width: 400, height: 300 };
const area = ({ width, height }: { width: number; height: number }) => width * height;

it('gives each weight its share of the area, in rows that are read like text', () => {
  const boxes = strips([1, 1, 1, 1, 2, 2], BOX, LEAST, 0);
  expect(boxes.map(area).reduce((sum, each) => sum + each)).toBeCloseTo(400 * 300);
  expect(area(boxes[4]!)).toBeCloseTo(2 * area(boxes[0]!));
  expect(boxes[0]).toMatchObject({ x: 10, y: 20 });
  for (const [at, box] of boxes.entries()) {
    const next = boxes[at + 1];
    if (next) expect(next.y > box.y || (next.y === box.y && next.x > box.x)).toBe(true);
  }
});

it('leaves the gap between boxes, and fills the box', () => {
  const boxes = strips(
    Array.from({ length: 12 }, () => 1),
    BOX,
    LEAST,
    4,
  );
  expect(Math.max(...boxes.map(({ x, width }) => x + width))).toBeCloseTo(410);
  expect(Math.max(...boxes.map(({ y, height }) => y + height))).toBeCloseTo(320);
  const [first, second] = boxes;
  expect(second!.x - first!.x - first!.width).toBeCloseTo(4);
});

it('gives a small weight beside a large one room for a name', () => {
  for (const { width, height } of strips([500, 1, 1], BOX, LEAST, 3)) {
    expect(width).toBeGreaterThanOrEqual(40);
    expect(height).toBeGreaterThanOrEqual(14);
  }
});

it('divides evenly where there is no room for names, and returns nothing for nothing', () => {
  expect(strips([], BOX, LEAST, 3)).toEqual([]);
  const crowd = strips(
    Array.from({ length: 2000 }, () => 1),
    { ...BOX, width: 60, height: 40 },
    LEAST,
    0,
  );
  expect(crowd).toHaveLength(2000);
  expect(crowd.every(({ width, height }) => width > 0 && height > 0)).toBe(true);
});
