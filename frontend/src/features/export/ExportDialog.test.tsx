import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { closeExportDialog, openExportDialog, useExportDialog } from '@/store/dialogs/export';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { ExportDialog } from './ExportDialog';

it('opens on demand, and closes', async () => {
  onTestFinished(closeExportDialog);
  fakeServer({});
  openProject({});
  show(<ExportDialog />);
  expect(screen.queryByRole('dialog')).toBeNull();
  act(openExportDialog);
  expect(screen.getByRole('dialog', { name: 'Download' })).toBeInTheDocument();
  expect(await screen.findByTestId('take-away')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Close' }));
  expect(useExportDialog.getState().isOpen).toBe(false);
  expect(screen.queryByRole('dialog')).toBeNull();
});
