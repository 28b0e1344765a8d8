import { expect, it } from 'vitest';
import { outcome, rowsOf } from '../../../harness/evaluations';
import { worst } from './worst';

it('has crashes first, then those that missed by most, and none that does not count', () => {
  const rows = rowsOf(
    outcome(0),
    outcome(1, { outcome: 'failure', margin: -0.1 }),
    outcome(2, { outcome: 'failure', margin: -0.4 }),
    outcome(3, { outcome: 'crashed', margin: null }),
    outcome(4, { outcome: 'lost' }),
  );
  expect(worst(rows).map(({ seed }) => seed)).toEqual([3, 2, 1]);
});
