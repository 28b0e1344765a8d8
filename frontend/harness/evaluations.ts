import type { Evaluation, Outcome } from '@/api/evaluations';

/** Returns the outcome of a run for a test. */
export const outcome = (seed: number, more: Partial<Outcome> = {}): Outcome => ({
  seed,
  outcome: 'success',
  why: 'all items hold',
  end_s: 20,
  margin: 0.5,
  unit: 'm',
  measures: { path_length_m: seed },
  ...more,
});

export const rowsOf = (...outcomes: Outcome[]): ReadonlyMap<number, Outcome> =>
  new Map(outcomes.map((each) => [each.seed, each]));

/** Returns an evaluation of four runs, two of which are done, for a test. */
export const evaluation = (more: Partial<Evaluation> = {}): Evaluation => ({
  id: 'e1',
  name: 'room',
  revision: 7,
  older: null,
  seed: 0,
  sealed: false,
  sequential: false,
  duration_s: 20,
  workers: 2,
  state: 'running',
  waits_for: '',
  error: '',
  notes: '',
  attempt: 1,
  left_s: 75,
  author: 'ada',
  created_at: '2026-01-01T00:00:00Z',
  ended_at: null,
  sides: [
    { revision: 7, done: 2, wanted: 4, rate: 0.5, low: 0.1, high: 0.9, counts: { success: 1, failure: 1 } },
  ],
  ...more,
});
