import { act, screen, waitFor } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { setEngineLink } from '@/store/moment/looking';
import { noRange, useRange } from '@/store/moment/range';
import { atPresent, useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import type { Changes as Found } from '@/store/recording/types';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../harness/canvas';
import { segmentOf } from '../../../harness/runs';
import { show, user } from '../../../harness/testing';
import { treeNode } from '../../../harness/running';
import { Changes } from './Changes';

const found: Found = {
  statuses: [{ uid: 1, path: 'drive', from: 'RUNNING', to: 'IDLE' }],
  entries: [{ scope: '', key: 'speed', from: 1, to: 2, since: 3.5 }],
  poses: [{ id: 7, metres: 0.25, degrees: 10 }],
};
const between = vi.fn<(from: number, to: number) => Promise<Found | null>>();
const segment = segmentOf({ to_t: 9, bytes: 0 });

beforeEach(() => {
  between.mockResolvedValue(found);
  setEngineLink(() => ({ post: () => undefined, onMessage: () => undefined }));
  useSessionStore.setState({ segments: [segment] });
  useRange.setState({ a: 2, isComparing: true });
});
afterEach(() => {
  useRange.setState(noRange);
  useMoment.setState(atPresent, true);
  useSessionStore.setState(initialSession, true);
  vi.clearAllMocks();
});

it('lists statuses, keys and bodies between A and the shown moment, or B', async () => {
  useMoment.setState({ t: 4 });
  show(<Changes end={9} between={between} />);
  const lines = await screen.findAllByTestId('axis-change');
  expect(lines.map(({ textContent }) => textContent)).toEqual([
    'drive: RUNNING → IDLE',
    'speed: 1 → 2',
    '#7 moved 0.250 m and turned 10°',
  ]);
  expect(between).toHaveBeenLastCalledWith(2, 4);
  act(() => useRange.setState({ b: 6 }));
  await waitFor(() => expect(between).toHaveBeenLastCalledWith(2, 6));
});

it('a line leads to its block, or to the moment of the write', async () => {
  openDiagram({ root: 'n1', nodes: { n1: { type: 'Sequence' } } });
  useMoment.setState({ tree: [{ ...treeNode(1, 0, 'n1'), ports: {} }] });
  show(<Changes end={9} between={between} />);
  const [status, key] = await screen.findAllByTestId('axis-change');
  await user.click(status!);
  expect(useProjectStore.getState().revealed?.node).toBe('n1');
  await user.click(key!);
  expect(useMoment.getState().t).toBe(3.5);
});

it('says when nothing changed, and that a part is not read; a button closes it', async () => {
  between.mockResolvedValueOnce(null);
  show(<Changes end={9} between={between} />);
  expect(await screen.findByText('Reading the recording…')).toBeVisible();
  between.mockResolvedValueOnce({ statuses: [], entries: [], poses: [] });
  act(() => useRange.setState({ b: 5 }));
  expect(await screen.findByText('Nothing changed.')).toBeVisible();
  await user.click(screen.getByRole('button', { name: 'Close the changes' }));
  expect(screen.queryByTestId('axis-changes')).toBeNull();
});
