import { afterEach, expect, it, vi } from 'vitest';
import type { Overview } from '@/store/recording/types';
import { shownTrail } from '@/store/session/trace/shownTrail';
import { showPresentTrail, showTrail } from './trail';

const overview = (): Overview => ({ run: 'a', read: [], root: [], marks: [], lines: [], faults: [] });
const path = Float32Array.from([0, 0, 0, 1]);

afterEach(showPresentTrail);

it('reads the recorded path once for each part of the recording that was read', async () => {
  const read = vi.fn().mockResolvedValue(path);
  const first = overview();
  await showTrail(1, first, true, read);
  expect(shownTrail).toMatchObject({ until: 1, points: path });
  await showTrail(2, first, true, read);
  expect(read).toHaveBeenCalledTimes(1);
  expect(shownTrail).toMatchObject({ until: 2, points: path });
  await showTrail(2, overview(), true, read);
  expect(read).toHaveBeenCalledTimes(2);
});

it('shows nothing of the present run’s path in another run, and no path that comes too late', async () => {
  let answer = (_: Float32Array) => {};
  const shown = showTrail(1, overview(), false, () => new Promise((resolve) => (answer = resolve)));
  expect(shownTrail.points).toHaveLength(0);
  showPresentTrail();
  answer(path);
  await shown;
  expect(shownTrail).toMatchObject({ until: null, points: null });
});
