import { beforeEach, expect, it } from 'vitest';
import { revision } from '../../../harness/requests';
import { setComparison, sidesOf, useComparison, type Against, type Comparison } from './compare';

const comparison = (against: Against): Comparison => ({
  revision: revision(5),
  before: 2,
  against,
  path: null,
});

beforeEach(() => useComparison.setState({ comparison: null }));

it.each([
  ['before', [2, 5]],
  ['now', [5, 9]],
  [3, [3, 5]],
  [7, [5, 7]],
] as const)('compares with %s, the older side first', (against, sides) => {
  expect(sidesOf(comparison(against), 9)).toEqual(sides);
});

it('changes a part of the comparison, if there is one', () => {
  setComparison({ against: 'now' });
  expect(useComparison.getState().comparison).toBeNull();
  useComparison.setState({ comparison: comparison('before') });
  setComparison({ path: 'a.py' });
  expect(useComparison.getState().comparison).toEqual({ ...comparison('before'), path: 'a.py' });
});
