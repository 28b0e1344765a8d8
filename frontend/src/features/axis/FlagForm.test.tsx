import { fireEvent, screen, waitFor } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import * as connection from '@/store/session/connection';
import { noFlags, useFlags } from '@/store/moment/flags';
import { show, user } from '../../../harness/testing';
import { FlagForm } from './FlagForm';

afterEach(() => {
  vi.restoreAllMocks();
  useFlags.setState(noFlags);
});

const draft = { run: 'a', id: '', t: 2, text: '' };

it('sets a flag by keys alone', async () => {
  const send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useFlags.setState({ draft });
  show(<FlagForm />);
  expect(screen.getByLabelText('Flag at 2.00 s')).toHaveFocus();
  expect(screen.getByTestId('flag-keep')).toBeDisabled();
  await user.keyboard(' it turns {Enter}');
  await waitFor(() => expect(useFlags.getState().draft).toBeNull());
  expect(send).toHaveBeenCalledWith('flag', { run: 'a', id: '', t: 2, text: 'it turns', user: '' });
});

it('says why a flag is refused, and keeps the text', async () => {
  vi.spyOn(connection, 'send').mockRejectedValue(new Error('A run has at most 200 flags.'));
  useFlags.setState({ draft });
  show(<FlagForm />);
  await user.keyboard('x{Enter}');
  expect(await screen.findByText('A run has at most 200 flags.')).toBeVisible();
  expect(screen.getByTestId('flag-text')).toHaveValue('x');
});

it('is left by Escape, which does not reach the page', () => {
  const page = vi.fn();
  window.addEventListener('keydown', page);
  useFlags.setState({ draft });
  show(<FlagForm />);
  fireEvent.keyDown(screen.getByTestId('flag-text'), { key: 'Escape' });
  expect(useFlags.getState().draft).toBeNull();
  window.removeEventListener('keydown', page);
});

it('changes or removes a flag that is there', async () => {
  const send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useFlags.setState({ draft: { ...draft, id: 'f1', text: 'here' } });
  show(<FlagForm />);
  expect(screen.getByLabelText('Change the flag at 2.00 s')).toHaveValue('here');
  await user.click(screen.getByTestId('flag-remove'));
  expect(send).toHaveBeenCalledWith('flag', expect.objectContaining({ id: 'f1', text: '' }));
  expect(useFlags.getState().draft).toBeNull();
});
