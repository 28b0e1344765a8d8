import { screen, within } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { noFlags, useFlags } from '@/store/moment/flags';
import { setEngineLink } from '@/store/moment/looking';
import { atPresent, useMoment } from '@/store/moment/store';
import * as connection from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { INTRODUCTION, show, user } from '../../../harness/testing';
import { Marks } from './Marks';

const segment = {
  branch: 0,
  number: 0,
  version: 0,
  from_t: 0,
  to_t: 10,
  bytes: 1,
  complete: false,
  run_number: 1,
  result: null,
};
const extent = { run: 'a', from: 0, to: 10 };

beforeEach(() => {
  setEngineLink(() => ({ post: () => undefined, onMessage: () => undefined }));
  useSessionStore.setState({
    segments: [{ ...segment, run: 'a' }],
    connection: 'open',
    introspection: INTRODUCTION,
    flags: [{ run: 'a', id: 'f1', t: 4, text: 'here', user: '' }],
    stops: [{ run: 'a', t: 9, reason: 'recorder_died', detail: 'It was killed.', goes_on: true }],
  });
  useFlags.setState({ isListed: true });
});
afterEach(() => {
  vi.restoreAllMocks();
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useFlags.setState(noFlags);
});

it('lists all marks; each goes to its moment', async () => {
  show(<Marks extent={extent} />);
  const lines = screen.getAllByTestId('mark-line');
  expect(lines.map(({ textContent }) => textContent)).toEqual([
    'Flag at 4.00 s: here',
    expect.stringContaining('what happened until it had started is missing'),
  ]);
  await user.click(within(lines[0]!).getByRole('button', { name: 'Flag at 4.00 s: here' }));
  expect(useMoment.getState().t).toBe(4);
});

it('changes and removes the flags of the user, and no other mark', async () => {
  const send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  show(<Marks extent={extent} />);
  expect(screen.getAllByTestId('mark-edit')).toHaveLength(1);
  await user.click(screen.getByRole('button', { name: 'Change the flag “here”' }));
  expect(useFlags.getState().draft).toEqual({ run: 'a', id: 'f1', t: 4, text: 'here' });
  await user.click(screen.getByRole('button', { name: 'Remove the flag “here”' }));
  expect(send).toHaveBeenCalledWith('flag', expect.objectContaining({ id: 'f1', text: '' }));
});

it('is read by a viewer, who changes nothing', () => {
  useSessionStore.setState({ introspection: { ...INTRODUCTION, role: 'viewer' } });
  show(<Marks extent={extent} />);
  expect(screen.getAllByTestId('mark-line')).toHaveLength(2);
  expect(screen.queryByTestId('mark-remove')).toBeNull();
});
