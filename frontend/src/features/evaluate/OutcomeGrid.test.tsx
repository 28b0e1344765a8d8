import { fireEvent, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { outcome, rowsOf } from '../../../harness/evaluations';
import { show } from '../../../harness/testing';
import { CELL_PX } from './cells';
import { OutcomeGrid } from './OutcomeGrid';

function open(chosen: number | null) {
  const did = { onChoose: vi.fn(), onPlay: vi.fn() };
  const rows = rowsOf(outcome(10), outcome(11, { outcome: 'failure', margin: -0.1 }));
  show(<OutcomeGrid first={10} cells={40} rows={rows} chosen={chosen} marked={new Set()} {...did} />);
  return { ...did, grid: screen.getByRole('slider', { name: 'Runs by seed' }) };
}

it('tells the seed, outcome and margin of a cell', () => {
  const { grid } = open(11);
  expect(grid).toHaveAttribute('aria-valuetext', 'Seed 11: failure after 20 s, margin -0.1 m');
  expect(grid).toHaveAttribute('aria-valuenow', '11');
});

it('moves by keys, and plays what has run', () => {
  const { grid, onChoose, onPlay } = open(11);
  fireEvent.keyDown(grid, { key: 'ArrowRight' });
  fireEvent.keyDown(grid, { key: 'End' });
  expect(onChoose.mock.calls).toEqual([[12], [49]]);
  fireEvent.keyDown(grid, { key: 'Enter' });
  expect(onPlay).toHaveBeenCalledWith(11);
});

it('begins with the first cell, and plays nothing that has not run', () => {
  const first = open(null);
  fireEvent.keyDown(first.grid, { key: 'ArrowRight' });
  expect(first.onChoose).toHaveBeenCalledWith(10);
});

it('chooses the cell that is clicked', () => {
  const { grid, onChoose } = open(null);
  fireEvent.click(grid, { clientX: 2 * CELL_PX + 2, clientY: 3 });
  expect(onChoose).toHaveBeenCalledWith(12);
});
