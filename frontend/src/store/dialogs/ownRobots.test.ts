import { expect, it } from 'vitest';
import { closeOwnRobots, openOwnRobots, useOwnRobots } from './ownRobots';

it('opens and closes', () => {
  openOwnRobots();
  expect(useOwnRobots.getState().isOpen).toBe(true);
  closeOwnRobots();
  expect(useOwnRobots.getState().isOpen).toBe(false);
});
