import type { Outcome } from '@/api/evaluations';

export interface Bins {
  readonly from: number;
  readonly to: number;
  /** Successes and other outcomes of each bin, from the smallest values to the largest. */
  readonly bins: readonly { readonly successes: number; readonly others: number }[];
  readonly count: number;
  readonly median: number;
}

const BINS = 20;

/** Returns the names of the measures that some outcome has. */
export const measuresOf = (outcomes: readonly Outcome[]): string[] => [
  ...new Set(outcomes.flatMap(({ measures }) => Object.keys(measures))),
];

/** Returns the distribution of a measure; null if no outcome has it. */
export function binsOf(outcomes: readonly Outcome[], measure: string): Bins | null {
  const found = outcomes.flatMap(({ outcome, measures }) => {
    const value = measures[measure];
    return value === undefined ? [] : [{ value, isSuccess: outcome === 'success' }];
  });
  if (found.length === 0) return null;
  const sorted = found.map(({ value }) => value).sort((a, b) => a - b);
  const from = sorted[0] ?? 0;
  const to = sorted.at(-1) ?? 0;
  const bins = Array.from({ length: BINS }, () => ({ successes: 0, others: 0 }));
  for (const { value, isSuccess } of found) {
    const share = to > from ? (value - from) / (to - from) : 0.5;
    const bin = bins[Math.min(BINS - 1, Math.floor(share * BINS))];
    if (bin) bin[isSuccess ? 'successes' : 'others'] += 1;
  }
  const middle = sorted.length / 2;
  const median =
    sorted.length % 2 === 1
      ? (sorted[Math.floor(middle)] ?? 0)
      : ((sorted[middle - 1] ?? 0) + (sorted[middle] ?? 0)) / 2;
  return { from, to, bins, count: found.length, median };
}
