import { expect, it } from 'vitest';
import { minutes, pathOf } from './present';

it.each([
  [0, '0:00'],
  [59.99, '0:59'],
  [60, '1:00'],
  [754.2, '12:34'],
])('%d s are %s', (seconds, text) => {
  expect(minutes(seconds)).toBe(text);
});

it('names the page of a run', () => {
  const id = '00000001-0000-0000-0000-000000000000';
  expect(pathOf({ project: 'p 1', id })).toBe(`/projects/p%201?run=${id}`);
});
