import { describe, expect, it } from 'vitest';
import { Slowness } from './slowness';

/** Requests a picture every 33 ms and draws one every `drawMs`; returns the rates that were too slow. */
function watch(seconds: number, drawMs: number, slowness = new Slowness(), start = 0) {
  const verdicts: number[] = [];
  let drawn = start;
  for (let now = start; now < start + seconds * 1000; now += 33) {
    slowness.request(now);
    if (now - drawn >= drawMs) {
      drawn = now;
      slowness.draw(now);
    }
    const hz = slowness.tooSlow(now);
    if (hz !== null) verdicts.push(hz);
  }
  return verdicts;
}

describe('the verdict on a slow view', () => {
  it('comes after three seconds under five pictures a second', () => {
    expect(watch(3, 400)).toEqual([]);
    const [hz] = watch(4, 400);
    expect(hz).toBeGreaterThan(2);
    expect(hz).toBeLessThan(3);
  });

  it('does not come for a view that is quick enough', () => {
    expect(watch(20, 150)).toEqual([]);
  });

  it('does not come for a paused world', () => {
    const slowness = new Slowness();
    for (let now = 0; now < 20_000; now += 1000) {
      slowness.request(now);
      slowness.draw(now + 10);
      expect(slowness.tooSlow(now + 10)).toBeNull();
    }
  });

  it('does not count the first picture, which loads everything', () => {
    expect(watch(6, 5000)).toEqual([]);
  });

  it('starts again in a window that was hidden', () => {
    const slowness = new Slowness();
    expect(watch(2.5, 400, slowness)).toEqual([]);
    slowness.forget();
    expect(watch(2.5, 400, slowness, 2500)).toEqual([]);
  });

  it('counts each period from zero', () => {
    const slowness = new Slowness();
    const hz: (number | null)[] = [];
    for (let now = 0; now <= 6000; now += 500) {
      slowness.request(now);
      slowness.draw(now);
      const rate = slowness.tooSlow(now);
      if (rate !== null) hz.push(rate);
    }
    expect(hz).toEqual([2, 2]);
  });
});
