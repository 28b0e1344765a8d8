import { act, screen, waitFor } from '@testing-library/react';
import { describe, expect, it, onTestFinished } from 'vitest';
import {
  closeUniverseChooser,
  openUniverseChooser,
  useUniverseChooser,
} from '@/store/dialogs/universeChooser';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { UniverseDialog } from './UniverseDialog';

describe('the dialogue for universe and robot', () => {
  it('has the choices while it is open, and closes', async () => {
    onTestFinished(closeUniverseChooser);
    fakeServer({ 'GET /catalog/universes': [], 'GET /catalog/robots': [] });
    openProject({});
    show(<UniverseDialog />);
    expect(screen.queryByRole('dialog')).toBeNull();
    act(() => openUniverseChooser());
    expect(screen.getByRole('dialog', { name: 'Where the robot is' })).toBeInTheDocument();
    expect(await screen.findByTestId('worlds', {}, { timeout: 20_000 })).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Close' }));
    expect(useUniverseChooser.getState().isOpen).toBe(false);
    await waitFor(() => expect(screen.queryByTestId('worlds')).toBeNull());
  });
});
