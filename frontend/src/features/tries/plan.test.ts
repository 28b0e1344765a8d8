import { expect, it } from 'vitest';
import { outcomeOf } from '../../../harness/tries';
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
