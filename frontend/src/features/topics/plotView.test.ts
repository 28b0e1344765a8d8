import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { commonUnit, moved, unitOf, zoomed } from './plotView';

describe('zoomed', () => {
  it('keeps the time under the pointer at its place', () => {
    const share = fc.double({ min: 0, max: 1, noNaN: true });
    fc.assert(
      fc.property(share, fc.double({ min: 0.2, max: 5, noNaN: true }), (part, factor) => {
        const { min, max } = zoomed({ min: 10, max: 30 }, 10 + 20 * part, factor);
        expect(max - min).toBeCloseTo(20 * factor, 6);
        expect((10 + 20 * part - min) / (max - min)).toBeCloseTo(part, 6);
      }),
    );
  });

  it('stops at the smallest readable range', () => {
    const { min, max } = zoomed({ min: 1, max: 1.02 }, 1, 0.001);
    expect(max - min).toBeCloseTo(0.01, 9);
  });
});

it('moves', () => {
  expect(moved({ min: 1, max: 3 }, -0.5)).toEqual({ min: 0.5, max: 2.5 });
});

describe('unitOf', () => {
  it.each([
    ['twist.twist.linear.x', 'm/s'],
    ['angular.z', 'rad/s'],
    ['pose.pose.position.y', 'm'],
    ['ranges[12]', 'm'],
    ['linear_acceleration.z', 'm/s²'],
    ['pose.pose.orientation.w', ''],
    ['data', ''],
  ])('of %s is %j', (path, unit) => {
    expect(unitOf(path)).toBe(unit);
  });

  it('is common or none', () => {
    expect(commonUnit(['linear.x', 'linear.y'])).toBe('m/s');
    expect(commonUnit(['linear.x', 'angular.z'])).toBe('');
    expect(commonUnit([])).toBe('');
  });
});
