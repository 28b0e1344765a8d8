import { describe, expect, it } from 'vitest';
import { shortValue, SPARK, sparkPoints } from './spark';

describe('shortValue', () => {
  it.each([
    [0.123456, '0.1235'],
    [-12345678, '-12345678'],
    [1e-9, '1e-9'],
    [true, 'true'],
    [null, '—'],
    ['door', 'door'],
    ['a\nb', 'a…'],
    [[1, 2], '[1,2]'],
    ['x'.repeat(25), `${'x'.repeat(23)}…`],
  ])('shows %o as %s', (value, text) => {
    expect(shortValue(value)).toBe(text);
  });
});

describe('sparkPoints', () => {
  it('puts the newest at the right, between the least and the greatest', () => {
    expect(sparkPoints([2, 0, 1])).toBe('56.9,1.0 58.5,13.0 60.0,7.0');
  });

  it('is level for a value that stays', () => {
    expect(sparkPoints([3, 3])).toBe('58.5,7.0 60.0,7.0');
  });

  it('shows only the last samples', () => {
    const points = sparkPoints(Array.from({ length: SPARK.samples + 5 }, (_, index) => index)).split(' ');
    expect(points).toHaveLength(SPARK.samples);
    expect(points[0]).toBe('0.0,13.0');
  });
});
