import { expect, it } from 'vitest';
import { ApiError } from '@/api/errors';
import { CommandError } from '@/store/session/control';
import { reasonOf } from './reason';

it('gives the message of an error, with the hint of the server or the session', () => {
  const problem = { title: 'Refused', status: 400, code: 'refused', detail: 'No room.' };
  expect(reasonOf(new Error('broken'))).toBe('broken');
  expect(reasonOf('odd')).toBe('odd');
  expect(reasonOf(new ApiError(problem))).toBe('No room.');
  expect(reasonOf(new ApiError({ ...problem, hint: 'Delete one.' }))).toBe('No room. Delete one.');
  expect(reasonOf(new CommandError('port_taken', 'It is taken.', 'Choose another.'))).toBe(
    'It is taken. Choose another.',
  );
  expect(reasonOf(new CommandError('port_taken', 'It is taken.', ''))).toBe('It is taken.');
});
