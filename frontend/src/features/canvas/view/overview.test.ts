import { describe, expect, it } from 'vitest';
import { boundsOf, frameOf, shrink } from './overview';

const picture = { width: 168, height: 112 };
const box = (x: number, y: number, width: number, height: number) => ({ x, y, width, height });

describe('shrink', () => {
  it('keeps the proportions of a tree of common size, and puts it into the middle', () => {
    const { sx, sy, left, top } = shrink(box(-500, 0, 1000, 600), picture);
    expect(sx).toBe(sy);
    expect(left).toBeCloseTo(84);
    expect(top + 300 * sy).toBeCloseTo(56);
  });

  it('stretches a tree that is far wider than high until its blocks are visible', () => {
    const { sx, sy } = shrink(box(0, 0, 60_000, 700), picture);
    expect(60_000 * sx).toBeCloseTo(156);
    expect(44 * sy).toBeGreaterThan(3);
    expect(700 * sy).toBeLessThanOrEqual(100);
  });

  it('accepts an empty tree', () => {
    expect(boundsOf([])).toEqual(box(0, 0, 0, 0));
    expect(Object.values(shrink(boundsOf([]), picture)).every(Number.isFinite)).toBe(true);
  });
});

describe('frameOf', () => {
  const shrinking = shrink(box(0, 0, 60_000, 700), picture);

  it('is never too small to be visible', () => {
    const { width, height } = frameOf(box(30_000, 0, 1000, 700), shrinking, picture);
    expect(width).toBe(6);
    expect(height).toBeGreaterThan(50);
  });

  it('stays in the picture when the view has left the tree', () => {
    for (const x of [-1e6, 1e6]) {
      const frame = frameOf(box(x, x, 1000, 700), shrinking, picture);
      expect(frame.x).toBeGreaterThanOrEqual(0);
      expect(frame.y).toBeGreaterThanOrEqual(0);
      expect(frame.x + frame.width).toBeLessThanOrEqual(picture.width);
      expect(frame.y + frame.height).toBeLessThanOrEqual(picture.height);
      expect(frame.width).toBeGreaterThan(0);
    }
  });
});
