import { expect, it } from 'vitest';
import { RecordingError, STATUSES } from './types';

it('says what is wrong and where', () => {
  const error = new RecordingError('damaged', 'A chunk is broken.', 'segment 3, before byte 70');
  expect(error).toMatchObject({ code: 'damaged', message: 'A chunk is broken. (segment 3, before byte 70)' });
});

it('numbers the statuses as the recorder does', () => {
  expect(STATUSES).toEqual(['IDLE', 'RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED']);
});
