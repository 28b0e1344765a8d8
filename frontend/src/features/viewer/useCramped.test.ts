import { expect, it } from 'vitest';
import { isCramped } from './useCramped';

it.each([
  [430, 370, false],
  [390, 250, true],
  [700, 140, true],
  [0, 0, false],
])('a view of %s × %s px is cramped: %s', (width, height, cramped) => {
  expect(isCramped(width, height)).toBe(cramped);
});
