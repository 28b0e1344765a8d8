import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { closeSettings, openSettings, useSettingsDialog } from '@/store/dialogs/settings';
import { openProject, show, user } from '../../../harness/testing';
import { Settings } from './Settings';

it('opens on demand, and closes', async () => {
  onTestFinished(closeSettings);
  openProject({});
  show(<Settings />);
  expect(screen.queryByRole('dialog')).toBeNull();
  act(openSettings);
  expect(screen.getByRole('dialog', { name: 'Settings of the project' })).toBeInTheDocument();
  expect(screen.getByLabelText('Name')).toHaveValue('Test');
  await user.click(screen.getByRole('button', { name: 'Close' }));
  expect(useSettingsDialog.getState().isOpen).toBe(false);
  expect(screen.queryByTestId('settings')).toBeNull();
});
