import { expect, it } from 'vitest';
import { closeRenameKey, openRenameKey, useRenameKey } from './renameKey';

it('opens for a key, or for a choice, and closes', () => {
  openRenameKey({ board: 'Main', name: 'k' });
  expect(useRenameKey.getState()).toEqual({ isOpen: true, key: { board: 'Main', name: 'k' } });
  openRenameKey();
  expect(useRenameKey.getState()).toEqual({ isOpen: true, key: null });
  closeRenameKey();
  expect(useRenameKey.getState().isOpen).toBe(false);
});
