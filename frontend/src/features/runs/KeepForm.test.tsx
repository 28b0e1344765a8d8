import { act, screen, waitFor } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import type { Segment } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { show, user } from '../../../harness/testing';
import { segmentOf } from '../../../harness/runs';
import { KeepForm } from './KeepForm';

afterEach(() => useSessionStore.setState(initialSession, true));

it('is there only while something is recorded', () => {
  show(<KeepForm onKeep={vi.fn()} />);
  expect(screen.queryByRole('textbox')).toBeNull();
});

it('has a name already, and forgets the note of a kept run alone', async () => {
  useSessionStore.setState({ segments: [{ run: 'a1' } as Segment] });
  const onKeep = vi.fn().mockResolvedValueOnce(false).mockResolvedValue(true);
  show(<KeepForm onKeep={onKeep} />);
  const note = screen.getByRole('textbox', { name: 'Note' });
  expect(screen.getByRole('textbox', { name: 'Name' })).not.toHaveValue('');
  await user.type(note, ' slow ');
  await user.click(screen.getByRole('button', { name: 'Keep' }));
  expect(onKeep).toHaveBeenCalledWith(expect.objectContaining({ run: 'a1', note: 'slow' }));
  expect(note).toHaveValue(' slow ');
  await user.click(screen.getByRole('button', { name: 'Keep' }));
  await waitFor(() => expect(note).toHaveValue(''));
});

it('keeps an earlier run of the session, too; one that is gone meanwhile is not offered', async () => {
  const [first, second] = [
    segmentOf({ run: 'a1', result: 'failure' }),
    segmentOf({ run: 'b2', run_number: 2 }),
  ];
  useSessionStore.setState({ segments: [first, second] });
  const onKeep = vi.fn().mockResolvedValue(true);
  show(<KeepForm onKeep={onKeep} />);
  const which = screen.getByRole('combobox', { name: 'Run' });
  expect(which).toHaveValue('b2');
  await user.selectOptions(which, 'Run 1 · ✗ FAILURE');
  await user.click(screen.getByRole('button', { name: 'Keep' }));
  expect(onKeep).toHaveBeenCalledWith(expect.objectContaining({ run: 'a1' }));
  act(() => useSessionStore.setState({ segments: [second] }));
  expect(screen.queryByRole('combobox', { name: 'Run' })).toBeNull();
  await user.click(screen.getByRole('button', { name: 'Keep' }));
  expect(onKeep).toHaveBeenLastCalledWith(expect.objectContaining({ run: 'b2' }));
});
