import { expect, it } from 'vitest';
import type { Segment } from '@/generated/messages';
import { minutes, recordedRun } from './present';

it('names the last run of the session', () => {
  const segments = ['a', 'b', 'b'].map((run) => ({ run }) as Segment);
  expect(recordedRun({ segments })).toBe('b');
  expect(recordedRun({ segments: [] })).toBeUndefined();
});

it.each([
  [0, '0:00'],
  [59.99, '0:59'],
  [60, '1:00'],
  [754.2, '12:34'],
])('%d s are %s', (seconds, text) => {
  expect(minutes(seconds)).toBe(text);
});
