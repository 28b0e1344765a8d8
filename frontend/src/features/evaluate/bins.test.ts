import { describe, expect, it } from 'vitest';
import { outcome } from '../../../harness/evaluations';
import { binsOf, measuresOf } from './bins';

describe('the distribution of a measure', () => {
  it('counts successes and others, and has the median', () => {
    const rows = [outcome(0), outcome(1), outcome(4, { outcome: 'failure' })];
    const bins = binsOf(rows, 'path_length_m');
    expect(bins).toMatchObject({ from: 0, to: 4, median: 1, count: 3 });
    expect(bins?.bins.reduce((sum, { successes }) => sum + successes, 0)).toBe(2);
    expect(bins?.bins.at(-1)).toEqual({ successes: 0, others: 1 });
  });

  it('is of those runs alone that have it', () => {
    expect(binsOf([outcome(0)], 'energy_j')).toBeNull();
    expect(binsOf([outcome(3), outcome(3)], 'path_length_m')).toMatchObject({ median: 3, count: 2 });
    expect(measuresOf([outcome(0), outcome(1, { measures: { energy_j: 1 } })])).toEqual([
      'path_length_m',
      'energy_j',
    ]);
  });
});
