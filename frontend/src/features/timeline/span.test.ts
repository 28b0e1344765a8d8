import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { marks, SHORTEST_S, spanOf, timeLabel, zoomed } from './span';

const share = fc.double({ min: 0, max: 1, noNaN: true });

describe('spanOf', () => {
  it('follows the run', () => {
    expect(spanOf(null, 30, 0, 100)).toEqual({ from: 70, to: 100 });
  });

  it('begins with the run while that is shorter than the span', () => {
    expect(spanOf(null, 30, 0, 10)).toEqual({ from: 0, to: 30 });
    expect(spanOf(null, 30, 5, 10)).toEqual({ from: 5, to: 35 });
  });

  it('stays where it was set', () => {
    expect(spanOf(50, 30, 0, 100)).toEqual({ from: 20, to: 50 });
  });

  it('shows nothing before the start or after the present of a run', () => {
    expect(spanOf(35, 30, 20, 100)).toEqual({ from: 20, to: 50 });
    expect(spanOf(500, 30, 0, 100)).toEqual({ from: 70, to: 100 });
    expect(spanOf(20, 30, 5, 10)).toEqual({ from: 5, to: 35 });
  });

  it('has its length, and begins within the run', () => {
    const time = fc.double({ min: 0, max: 600, noNaN: true });
    fc.assert(
      fc.property(
        fc.option(time),
        fc.double({ min: 0.5, max: 600, noNaN: true }),
        time,
        time,
        (end, length, begin, more) => {
          const { from, to } = spanOf(end, length, begin, begin + more);
          expect(to - from).toBeGreaterThanOrEqual(length - 1e-9);
          expect(from).toBeGreaterThanOrEqual(begin);
        },
      ),
    );
  });
});

describe('zoomed', () => {
  it('zooms about the start, the end, or a place between', () => {
    expect(zoomed({ from: 10, to: 40 }, 0.5, 0, 600)).toEqual({ from: 10, to: 25 });
    expect(zoomed({ from: 10, to: 40 }, 0.5, 1, 600)).toEqual({ from: 25, to: 40 });
    expect(zoomed({ from: 10, to: 40 }, 2, 0.5, 600)).toEqual({ from: -5, to: 55 });
  });

  it('keeps the time under the pointer where it is', () => {
    fc.assert(
      fc.property(share, fc.double({ min: 0.01, max: 50, noNaN: true }), (at, factor) => {
        const next = zoomed({ from: 10, to: 40 }, factor, at, 600);
        expect(next.from + (next.to - next.from) * at).toBeCloseTo(10 + 30 * at);
      }),
    );
  });

  it('is neither shorter than half a second nor longer than allowed', () => {
    expect(SHORTEST_S).toBe(0.5);
    expect(zoomed({ from: 10, to: 40 }, 0.001, 0, 600)).toEqual({ from: 10, to: 10.5 });
    expect(zoomed({ from: 10, to: 40 }, 100, 0, 90)).toEqual({ from: 10, to: 100 });
    expect(zoomed({ from: 0, to: 1 }, 9, 0, 0.1)).toEqual({ from: 0, to: 0.5 });
  });
});

describe('marks', () => {
  it('are at round times, with the first and the last one inside', () => {
    expect(marks({ from: 3, to: 63 }, 700)).toEqual([10, 20, 30, 40, 50, 60]);
    expect(marks({ from: 10, to: 30 }, 280)).toEqual([10, 15, 20, 25, 30]);
    expect(marks({ from: 0, to: 1 }, 700)).toEqual([
      0,
      0.1,
      0.2,
      3 * 0.1,
      0.4,
      0.5,
      6 * 0.1,
      7 * 0.1,
      0.8,
      0.9,
      1,
    ]);
  });

  it('use the next larger step if there is little room', () => {
    expect(marks({ from: 0, to: 60 }, 140)).toEqual([0, 30, 60]);
    expect(marks({ from: 0, to: 60 }, 139)).toEqual([0, 60]);
    expect(marks({ from: 0, to: 60 }, 600, 100)).toEqual([0, 10, 20, 30, 40, 50, 60]);
    expect(marks({ from: 0, to: 1200 }, 1)).toEqual([0, 600, 1200]);
    expect(marks({ from: 0, to: 600 }, 0)).toEqual([0, 600]);
  });

  it('are never too close', () => {
    fc.assert(
      fc.property(
        fc.double({ min: 0.5, max: 600, noNaN: true }),
        fc.integer({ min: 200, max: 2000 }),
        (to, width) => {
          const [first = 0, second = Infinity] = marks({ from: 0, to }, width);
          expect(((second - first) * width) / to).toBeGreaterThanOrEqual(70 - 1e-6);
        },
      ),
    );
  });
});

it.each([
  [0, '0 s'],
  [2.5, '2.5 s'],
  [2.567, '2.57 s'],
  [59.99, '59.99 s'],
  [60, '1:00'],
  [65, '1:05'],
  [119.96, '2:00'],
  [185, '3:05'],
  [185.5, '3:05.5'],
  [612.25, '10:12.3'],
])('labels %s s as %s', (time, label) => {
  expect(timeLabel(time)).toBe(label);
});
