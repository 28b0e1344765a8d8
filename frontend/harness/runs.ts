/** Data of runs for tests: a segment of a recording, and a kept run as the server lists it. */
import type { MyRun, StoredRun } from '@/api/runs';
import type { Segment } from '@/generated/messages';

/** Returns a complete segment of the run `a`, from 0 to 100 s. */
export const segmentOf = (more: Partial<Segment> = {}): Segment => ({
  run: 'a',
  branch: 0,
  number: 0,
  version: 0,
  from_t: 0,
  to_t: 100,
  bytes: 1,
  complete: true,
  run_number: 1,
  result: null,
  ...more,
});

/** Returns a kept run of the user `tina`. */
export const storedRun = (more: Partial<StoredRun> = {}): StoredRun => ({
  id: 'r1',
  name: 'Into the crate',
  note: '',
  result: 'failure',
  start_s: 0,
  length_s: 125,
  size: 2_500_000,
  is_pinned: false,
  is_shared: false,
  is_last: false,
  has_thumbnail: true,
  may_manage: true,
  may_share: true,
  keeper: 'tina',
  recorded_as: 'a1',
  created_at: new Date().toISOString(),
  ...more,
});

/** Returns one of the user's own runs, of the project `p1`. */
export const myRun = (number: number, more: Partial<MyRun> = {}): MyRun => ({
  ...storedRun({
    id: `0000000${number}-0000-0000-0000-000000000000`,
    name: `Run ${number}`,
    result: 'success',
    length_s: 65,
    size: 100,
  }),
  project: 'p1',
  project_name: 'Robot',
  may_open: true,
  ...more,
});
