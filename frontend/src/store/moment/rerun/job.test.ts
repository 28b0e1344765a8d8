import { expect, it } from 'vitest';
import { CommandError } from '@/store/session/control';
import { newJob, refusalOf } from './job';

it('makes names that the session takes', () => {
  expect(newJob()).toMatch(/^[0-9a-f]{16}$/);
  expect(newJob()).not.toBe(newJob());
});

it('says what was refused, and what to do', () => {
  expect(refusalOf(new CommandError('live_run', 'A live run.', 'Make it exact.'))).toBe(
    'A live run. Make it exact.',
  );
  expect(refusalOf(new Error('Lost.'))).toBe('Lost.');
  expect(refusalOf('gone')).toBe('gone');
});
