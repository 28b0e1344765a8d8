import { beforeEach, expect, it } from 'vitest';
import { keep3d, keeps3d } from './keep3d';

beforeEach(() => localStorage.clear());

it('keeps 3D after the user has chosen that', () => {
  expect(keeps3d()).toBe(false);
  keep3d();
  expect(keeps3d()).toBe(true);
});
