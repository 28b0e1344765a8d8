import { expect, it } from 'vitest';
import { reasonOf } from './reason';

it('is what an exception, the server or anything else says', () => {
  expect(reasonOf(new Error('lost'))).toBe('lost');
  expect(reasonOf({ code: -32602, message: 'not here' })).toBe('not here');
  expect([reasonOf('plain'), reasonOf(null)]).toEqual(['plain', 'null']);
});
