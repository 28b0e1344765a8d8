import { expect, it } from 'vitest';
import { closeRunsDialog, openRunsDialog, useRunsDialog } from './runs';

it('opens and closes', () => {
  openRunsDialog();
  expect(useRunsDialog.getState().isOpen).toBe(true);
  closeRunsDialog();
  expect(useRunsDialog.getState().isOpen).toBe(false);
});
