import { expect, it } from 'vitest';
import { closeMomentTest, openMomentTest, useMomentTest } from './momentTest';

it('opens and closes', () => {
  openMomentTest();
  expect(useMomentTest.getState().isOpen).toBe(true);
  closeMomentTest();
  expect(useMomentTest.getState().isOpen).toBe(false);
});
