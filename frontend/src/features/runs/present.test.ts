import { expect, it } from 'vitest';
import type { Fault, Finished, Segment } from '@/generated/messages';
import { minutes, recordedRun, resultOf } from './present';

const finished = (status: string) => ({ status }) as unknown as Finished;

it('names the last run of the session', () => {
  const segments = ['a', 'b', 'b'].map((run) => ({ run }) as Segment);
  expect(recordedRun({ segments })).toBe('b');
  expect(recordedRun({ segments: [] })).toBeUndefined();
});

it('tells how the run ended', () => {
  expect(resultOf({ faults: [], finished: null })).toBe('running');
  expect(resultOf({ faults: [], finished: finished('SUCCESS') })).toBe('success');
  expect(resultOf({ faults: [], finished: finished('FAILURE') })).toBe('failure');
  expect(resultOf({ faults: [{} as Fault], finished: finished('SUCCESS') })).toBe('error');
});

it.each([
  [0, '0:00'],
  [59.99, '0:59'],
  [60, '1:00'],
  [754.2, '12:34'],
])('%d s are %s', (seconds, text) => {
  expect(minutes(seconds)).toBe(text);
});
