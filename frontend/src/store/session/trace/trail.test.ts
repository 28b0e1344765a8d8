import { describe, expect, it } from 'vitest';
import { MAX_POINTS, Trail } from './trail';

const straight = (count: number): Trail => {
  const trail = new Trail();
  for (let step = 0; step < count; step += 1) trail.add(step * 0.1, 0, step);
  return trail;
};

describe('Trail', () => {
  it('grows while the robot moves, and not while it stands', () => {
    const trail = straight(10);
    trail.add(0.9, 0, 11);
    expect(trail.count).toBe(10);
  });

  it('restarts when the robot was moved by hand, or time went back', () => {
    const trail = straight(10);
    trail.add(-4, 0, 9.1);
    expect(trail.count).toBe(1);
    trail.add(-3.9, 0, 0);
    expect(trail.count).toBe(1);
  });

  it('drops the oldest half above the limit', () => {
    expect(straight(MAX_POINTS + 10).count).toBe(MAX_POINTS / 2 + 10);
  });

  it('is restored after a reload, and drops unreadable data', () => {
    const trail = new Trail();
    trail.restore(straight(10).keep());
    expect([trail.count, trail.time, trail.x(9)]).toEqual([10, 9, expect.closeTo(0.9)]);
    trail.restore('{damaged');
    trail.restore(null);
    expect(trail.count).toBe(10);
  });
});
