import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { panned, poseOf, START, turned, zoomed, type Orbit } from './orbit';

const LEVEL: Orbit = { target: [1, 2, 0.3], azimuth: 0, elevation: Math.PI / 4, distance: 10 };

describe('orbit', () => {
  it('turns by 8 mrad a pixel: to the right the world turns right, downwards the camera rises', () => {
    expect(turned(LEVEL, 100, 0).azimuth).toBeCloseTo(-0.8);
    expect(turned(LEVEL, 0, 50).elevation).toBeCloseTo(Math.PI / 4 + 0.4);
  });

  it('stays between the ground and straight above', () => {
    expect(turned(LEVEL, 0, 1e4).elevation).toBe(1.55);
    expect(turned(LEVEL, 0, -1e4).elevation).toBe(0.05);
  });

  it('is at the position of its angles', () => {
    const { eye, target } = poseOf(LEVEL);
    const flat = 10 * Math.SQRT1_2;
    expect(target).toEqual([1, 2, 0.3]);
    expect(eye).toEqual([expect.closeTo(1 + flat), expect.closeTo(2), expect.closeTo(0.3 + flat)]);
    const [x, y] = poseOf({ ...LEVEL, azimuth: Math.PI / 2 }).eye;
    expect([x, y]).toEqual([expect.closeTo(1), expect.closeTo(2 + flat)]);
  });

  it('moves with the pointer, more at a larger distance', () => {
    // Seen from +x, y points to the right of the screen, so a drag to the right moves the target left.
    expect(panned(LEVEL, 100, 0).target).toEqual([expect.closeTo(1), expect.closeTo(2 - 1.5), 0.3]);
    expect(panned(LEVEL, 0, 100).target).toEqual([expect.closeTo(1 - 1.5), expect.closeTo(2), 0.3]);
    expect(panned({ ...LEVEL, azimuth: Math.PI / 2, distance: 20 }, 100, 0).target).toEqual([
      expect.closeTo(1 + 3),
      expect.closeTo(2),
      0.3,
    ]);
  });

  it('zooms between half a metre and 60 m', () => {
    expect(zoomed(LEVEL, 0.5).distance).toBe(5);
    expect(zoomed(LEVEL, 0.01).distance).toBe(0.5);
    expect(zoomed(LEVEL, 100).distance).toBe(60);
  });

  it('keeps its distance however it is turned', () => {
    const pixels = fc.integer({ min: -2000, max: 2000 });
    fc.assert(
      fc.property(pixels, pixels, (dx, dy) => {
        const { eye, target } = poseOf(turned(START, dx, dy));
        const distance = Math.hypot(...eye.map((part, at) => part - (target[at] ?? 0)));
        expect(distance).toBeCloseTo(START.distance, 6);
        expect(eye[2]).toBeGreaterThan(0);
      }),
      { numRuns: 50 },
    );
  });
});
