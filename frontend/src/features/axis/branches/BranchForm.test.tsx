import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import { show, user } from '../../../../harness/testing';
import { useBranchForm } from '@/store/dialogs/branches';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { BranchForm } from './BranchForm';

let send: MockInstance<typeof connection.send>;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({ branches: [{ run: 'b', parent: 'a', from_t: 1.5, name: '', is_gone: false }] });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useBranchForm.setState({ run: null });
});

it('gives a branch a name', async () => {
  show(<BranchForm />);
  expect(screen.queryByRole('form')).toBeNull();
  act(() => useBranchForm.setState({ run: 'b' }));
  await user.type(screen.getByRole('textbox'), 'wider{Enter}');
  expect(send).toHaveBeenCalledWith('name_branch', { run: 'b', name: 'wider' });
  expect(screen.queryByRole('form')).toBeNull();
});

it('throws a branch away at the second press', async () => {
  useBranchForm.setState({ run: 'b' });
  show(<BranchForm />);
  await user.click(screen.getByTestId('branch-drop'));
  expect(send).not.toHaveBeenCalled();
  await user.click(screen.getByTestId('branch-drop'));
  expect(send).toHaveBeenCalledWith('drop_branch', { run: 'b' });
  expect(screen.queryByRole('form')).toBeNull();
});

it('stays open where that is refused, and closes with Escape', async () => {
  send.mockRejectedValue(new CommandError('present_run', 'This branch is the present.', ''));
  useBranchForm.setState({ run: 'b' });
  show(<BranchForm />);
  await user.click(screen.getByTestId('branch-drop'));
  await user.click(screen.getByTestId('branch-drop'));
  expect(await screen.findByText('This branch is the present.')).toBeVisible();
  await user.type(screen.getByRole('textbox'), '{Escape}');
  expect(screen.queryByRole('form')).toBeNull();
});
