import { screen, within } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import type { Diagnostic } from '@/api/types';
import { show, user } from '../../../harness/testing';
import { RepairDialog } from './RepairDialog';

const change = (line: number, before: string): Diagnostic => ({
  code: 'BT0740',
  severity: 'error',
  message: '',
  line,
  column: 2,
  values: { value: `a ${before} b`, before, after: '&amp;' },
});

const onRepair = vi.fn();
const onClose = vi.fn();
const open = (...changes: Diagnostic[]) =>
  show(
    <RepairDialog
      offer={{ asked: { file: new File([], 'tree.xml'), repair: false }, changes }}
      onRepair={onRepair}
      onClose={onClose}
    />,
  );

describe('RepairDialog', () => {
  it('lists each change, and asks for confirmation', async () => {
    open(change(3, '&'), change(7, '<'));
    expect(
      screen.getByText(/^tree.xml is not well-formed XML: 2 characters in attributes/),
    ).toBeInTheDocument();
    const rows = within(screen.getByTestId('repairs')).getAllByRole('row').slice(1);
    expect(
      rows.map((row) =>
        within(row)
          .getAllByRole('cell')
          .map(({ textContent }) => textContent),
      ),
    ).toEqual([
      ['3', 'a & b', '& → &amp;'],
      ['7', 'a < b', '< → &amp;'],
    ]);
    await user.click(screen.getByRole('button', { name: 'Repair and import' }));
    expect([onRepair.mock.calls.length, onClose.mock.calls.length]).toEqual([1, 0]);
    await user.click(screen.getByRole('button', { name: 'Do not import' }));
    expect([onRepair.mock.calls.length, onClose.mock.calls.length]).toEqual([1, 1]);
  });

  it('uses the singular for one change', () => {
    open(change(3, '&'));
    expect(screen.getByText(/a character in an attribute must be escaped/)).toBeInTheDocument();
  });

  it('is closed without an offer', () => {
    show(<RepairDialog offer={null} onRepair={onRepair} onClose={onClose} />);
    expect(screen.queryByRole('dialog')).toBeNull();
  });
});
