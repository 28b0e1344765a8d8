import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { MakeOwner } from './MakeOwner';

it('explains what a new owner means, and asks for confirmation', async () => {
  const onConfirm = vi.fn();
  const onCancel = vi.fn();
  const element = (isBusy: boolean) => (
    <MakeOwner who="bob" isBusy={isBusy} onConfirm={onConfirm} onCancel={onCancel} />
  );
  show(element(false));
  expect(screen.getByRole('alert')).toHaveTextContent('bob becomes the owner');
  await user.click(screen.getByRole('button', { name: 'Make bob the owner' }));
  expect([onConfirm.mock.calls.length, onCancel.mock.calls.length]).toEqual([1, 0]);
  await user.click(screen.getByRole('button', { name: 'Keep it' }));
  expect([onConfirm.mock.calls.length, onCancel.mock.calls.length]).toEqual([1, 1]);
});

it('is disabled while the server is asked', () => {
  show(<MakeOwner who="bob" isBusy onConfirm={() => undefined} onCancel={() => undefined} />);
  expect(screen.getByRole('button', { name: 'Make bob the owner' })).toBeDisabled();
  expect(screen.getByRole('button', { name: 'Keep it' })).toBeEnabled();
});
