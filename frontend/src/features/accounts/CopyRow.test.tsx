import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { CopyRow } from './CopyRow';

it('shows a link, selects it for copying, copies it, and revokes it', async () => {
  const onRevoke = vi.fn();
  show(<CopyRow url="https://studio/l/1" label="Read-only link" note="Made today" onRevoke={onRevoke} />);
  const field = screen.getByLabelText('Read-only link') as HTMLInputElement;
  expect(field).toHaveValue('https://studio/l/1');
  expect(field).toHaveAttribute('readonly');
  expect(field).toHaveAccessibleDescription('Made today');
  field.setSelectionRange(0, 0);
  await user.click(field);
  field.blur();
  field.focus();
  expect([field.selectionStart, field.selectionEnd]).toEqual([0, 18]);
  await user.click(screen.getByRole('button', { name: 'Copy' }));
  expect(await navigator.clipboard.readText()).toBe('https://studio/l/1');
  expect(onRevoke).not.toHaveBeenCalled();
  await user.click(screen.getByRole('button', { name: 'Revoke the link' }));
  expect(onRevoke).toHaveBeenCalledOnce();
});
