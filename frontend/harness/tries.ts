import type { TryOutcome } from '@/generated/messages';
import type { TriedPlace } from '@/store/session/tries';

export const place: TriedPlace = {
  run: 'a',
  t: 3.25,
  treeId: 'MainTree',
  nodeId: 'n6',
  path: 'Forward::6',
  port: 'lin_speed',
};

/** The outcome of a continuation that did nothing special. */
export const outcomeOf = (index: number, change: Partial<TryOutcome> = {}): TryOutcome => ({
  job: 'a1',
  index,
  end: 'running',
  message: '',
  t: 7.25,
  ticks: 80,
  root: 'RUNNING',
  nodes: ['Forward::6'],
  distance_m: index,
  collisions: 0,
  crash: null,
  paths: {
    robot: [
      [3.25, 0, 0],
      [7.25, index, 1],
    ],
  },
  fingerprint: String(index),
  as_before: index === 0,
  ...change,
});
