import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import type { ProfileSum } from '@/store/recording/profile';
import { treeNode } from '../../../harness/heldTree';
import { show } from '../../../harness/testing';
import { RangeProfile } from './RangeProfile';

const sum = {
  ticks: 4,
  tick_ms: 8,
  nodes: [
    { uid: 1, calls: 4, total_ms: 8, self_ms: 2 },
    { uid: 2, calls: 3, total_ms: 6, self_ms: 6 },
  ],
  tree: [
    { ...treeNode(1, 'r'), ports: {} },
    { ...treeNode(2, 'a'), parent: 1, ports: {} },
  ],
} satisfies ProfileSum;
const range = { from: 1, to: 2.5 };

it('shows the sum of a part of the recording', async () => {
  const between = vi.fn(() => Promise.resolve(sum));
  show(<RangeProfile range={range} between={between} />);
  expect(await screen.findByTestId('profile-range')).toHaveTextContent('1.00 s to 2.50 s');
  expect(screen.getByText(/4 ticks, 2.000 ms each/)).toBeInTheDocument();
  expect(between).toHaveBeenCalledWith(1, 2.5);
});

it('says that nothing was measured there, or that it is not read', async () => {
  const empty = { ticks: 0, tick_ms: 0, nodes: [], tree: [] };
  const { rerender } = show(<RangeProfile range={range} between={() => Promise.resolve(empty)} />);
  expect(await screen.findByText(/No node was measured/)).toBeInTheDocument();
  rerender(<RangeProfile range={range} between={() => Promise.resolve(null)} />);
  expect(await screen.findByText(/is being read/)).toBeInTheDocument();
});
