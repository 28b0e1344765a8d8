import { expect, it } from 'vitest';
import { RecordingError, recordedTime, STATUSES } from './types';

it('says what is wrong and where', () => {
  const error = new RecordingError('damaged', 'A chunk is broken.', 'segment 3, before byte 70');
  expect(error).toMatchObject({ code: 'damaged', message: 'A chunk is broken. (segment 3, before byte 70)' });
});

it('numbers the statuses as the recorder does', () => {
  expect(STATUSES).toEqual(['IDLE', 'RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED']);
});

it('is the same for times that differ by what arithmetic adds', () => {
  expect(recordedTime(12.100000000000001)).toBe(12.1);
  expect(recordedTime(12.099999999999998)).toBe(12.1);
  expect(recordedTime(12.100000001)).toBe(12.100000001);
});
