import { expect, it } from 'vitest';
import { ApiError } from '@/api/errors';
import { reasonOf } from './reason';

it('gives the message of an error, with the hint of the server', () => {
  const problem = { title: 'Refused', status: 400, code: 'refused', detail: 'No room.' };
  expect(reasonOf(new Error('broken'))).toBe('broken');
  expect(reasonOf(new ApiError(problem))).toBe('No room.');
  expect(reasonOf(new ApiError({ ...problem, hint: 'Delete one.' }))).toBe('No room. Delete one.');
});
