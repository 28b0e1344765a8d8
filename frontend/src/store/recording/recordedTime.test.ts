import { expect, it } from 'vitest';
import { recordedTime } from './recordedTime';

it('is the same for times that differ by what arithmetic adds', () => {
  expect(recordedTime(12.100000000000001)).toBe(12.1);
  expect(recordedTime(12.099999999999998)).toBe(12.1);
  expect(recordedTime(12.100000001)).toBe(12.100000001);
});
