import { describe, expect, it } from 'vitest';
import { following, markedRange, nextMoment, noRange, panned, useRange, within, zoomed } from './range';

const all = { from: 0, to: 100 };

describe('the zoom', () => {
  it('keeps the time under the pointer where it is, and ends at the whole run', () => {
    expect(zoomed(null, all, 0.5, 20)).toEqual({ from: 10, to: 60 });
    expect(zoomed({ from: 10, to: 60 }, all, 0.5, 20)).toEqual({ from: 15, to: 40 });
    expect(zoomed({ from: 10, to: 60 }, all, 3, 20)).toBeNull();
  });

  it('stays within the run, and has a shortest length', () => {
    expect(within({ from: 90, to: 120 }, all)).toEqual({ from: 70, to: 100 });
    const { from, to } = zoomed({ from: 50, to: 50.6 }, all, 0.1, 50.3) ?? all;
    expect(to - from).toBeCloseTo(0.5);
    expect(within({ from: 5, to: 6 }, { from: 0, to: 0.2 })).toEqual({ from: 0, to: 0.2 });
  });

  it('is moved by a share, and with the moment', () => {
    expect(panned({ from: 10, to: 20 }, all, 0.5)).toEqual({ from: 15, to: 25 });
    expect(panned(null, all, 0.5)).toBeNull();
    expect(following({ from: 10, to: 20 }, all, 15)).toEqual({ from: 10, to: 20 });
    expect(following({ from: 10, to: 20 }, all, 25)).toEqual({ from: 15, to: 25 });
    expect(following({ from: 10, to: 20 }, all, 4)).toEqual({ from: 4, to: 14 });
    expect(following(null, all, 4)).toBeNull();
  });
});

describe('the marked range', () => {
  it('is in order, and none without a length', () => {
    expect(markedRange({ a: 5, b: 2 })).toEqual({ from: 2, to: 5 });
    expect(markedRange({ a: 5, b: 5 })).toBeNull();
    expect(markedRange(noRange)).toBeNull();
    expect(useRange.getState()).toEqual(noRange);
  });

  it('is repeated while it loops, also when playing begins outside', () => {
    const loop = { from: 2, to: 5 };
    expect(nextMoment(4, 0.5, loop)).toBe(4.5);
    expect(nextMoment(4.8, 0.5, loop)).toBe(2);
    expect(nextMoment(9, 0.1, loop)).toBe(2);
    expect(nextMoment(9, 0.5, null)).toBe(9.5);
  });
});
