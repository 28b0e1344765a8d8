import { expect, it } from 'vitest';
import { readable } from './readable';

it.each([
  [143.2394, '°/s', 143],
  [1432.39, '°/s', 1432],
  [45.0000001, '°', 45],
  [0.5729578, '°', 0.573],
  [-57.29578, '°/s²', -57.3],
  [1.04719755, 'm', 1.047],
  [0.03441, 'm', 0.0344],
  [12.5, 'kg', 12.5],
  [0, '', 0],
])('%s %s is read as %s', (value, unit, shown) => {
  expect(readable(value, unit)).toBe(shown);
});
