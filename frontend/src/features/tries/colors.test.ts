import { expect, it } from 'vitest';
import { colorOf } from './colors';

it('gives each row a colour of its own', () => {
  expect(new Set(Array.from({ length: 51 }, (_, index) => colorOf(index))).size).toBe(51);
});
