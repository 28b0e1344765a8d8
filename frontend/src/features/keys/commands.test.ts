import { expect, it, onTestFinished } from 'vitest';
import { perform } from '@/commands/registry';
import { closeRenameKey, useRenameKey } from '@/store/dialogs/renameKey';
import { useProjectStore } from '@/store/project';
import { registerKeyCommands } from './commands';

it('opens the dialogue where edits are allowed', () => {
  onTestFinished(registerKeyCommands());
  useProjectStore.setState({ role: 'viewer' });
  perform('edit.renameKey');
  expect(useRenameKey.getState().isOpen).toBe(false);
  useProjectStore.setState({ role: 'owner' });
  perform('edit.renameKey');
  expect(useRenameKey.getState()).toEqual({ isOpen: true, key: null });
  closeRenameKey();
});
