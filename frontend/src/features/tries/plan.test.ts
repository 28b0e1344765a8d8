import { expect, it } from 'vitest';
import { outcomeOf } from '../../../harness/tries';
import { colorOf } from './colors';
import { pointsOf, viewOf } from './plan';

it('shows all paths with room around them, and y upwards', () => {
  expect(viewOf([outcomeOf(0), outcomeOf(3)])).toEqual([-1, -2, 5, 3]);
  expect(viewOf([outcomeOf(0, { paths: {} })])).toBeNull();
  expect(
    pointsOf([
      [1, 2],
      [3, -4],
    ]),
  ).toBe('1,-2 3,4');
});

it('gives each row a colour of its own', () => {
  expect(new Set(Array.from({ length: 51 }, (_, index) => colorOf(index))).size).toBe(51);
});
