import { act, screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { openRenameKey } from '@/store/dialogs/renameKey';
import { openProject, show, user } from '../../../harness/testing';
import { RenameKeyDialog } from './RenameKeyDialog';

it('opens for a key, and closes without a change', async () => {
  openProject({ trees: { Main: { r: { type: 'Sleep', ports: { msec: '{k}' } } } } });
  show(<RenameKeyDialog />);
  expect(screen.queryByRole('dialog')).toBeNull();
  act(() => openRenameKey({ board: 'Main', name: 'k' }));
  expect(screen.getByTestId('rename-key-new')).toHaveValue('k');
  await user.click(screen.getByRole('button', { name: 'Cancel' }));
  await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
});
