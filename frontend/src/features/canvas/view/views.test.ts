import { waitFor } from '@testing-library/react';
import { beforeEach, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../../harness/testing';
import {
  fit,
  fitSelection,
  fitSoon,
  isTooLarge,
  isTreeShown,
  showsTree,
  zoomIn,
  zoomOut,
  zoomReset,
} from './views';

const recording = () => ({ zoomIn: vi.fn(), zoomOut: vi.fn(), zoomTo: vi.fn(), fitView: vi.fn() });
const shows = (tree: string, view: ReturnType<typeof recording>) =>
  showsTree(tree, view as unknown as Parameters<typeof showsTree>[1]);

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } }, Dock: {} },
    selected: ['r', 'a'],
  });
});

it('act on the view of the tree in front', () => {
  const [main, dock] = [recording(), recording()];
  const ends = [shows('Main', main), shows('Dock', dock)];
  zoomIn();
  zoomOut();
  zoomReset();
  fit();
  fitSelection();
  expect(main.zoomIn).toHaveBeenCalledExactlyOnceWith({ duration: 120 });
  expect(main.zoomOut).toHaveBeenCalledExactlyOnceWith({ duration: 120 });
  expect(main.zoomTo).toHaveBeenCalledExactlyOnceWith(1, { duration: 120 });
  const how = { padding: 0.14, maxZoom: 1.1, minZoom: 0.004, duration: 200 };
  expect(main.fitView.mock.calls).toEqual([[how], [{ ...how, nodes: [{ id: 'r' }, { id: 'a' }] }]]);
  expect(dock.zoomIn).not.toHaveBeenCalled();
  ends.forEach((end) => end());
});

it('fits what is drawn next', async () => {
  const main = recording();
  const end = shows('Main', main);
  fitSoon();
  expect(main.fitView).not.toHaveBeenCalled();
  await waitFor(() => expect(main.fitView).toHaveBeenCalledOnce());
  end();
});

it('lets the last wish decide, also before what is drawn next', async () => {
  const main = recording();
  const end = shows('Main', main);
  fitSoon();
  fitSelection();
  await new Promise((resolve) => requestAnimationFrame(resolve));
  expect(main.fitView.mock.calls).toEqual([[expect.objectContaining({ nodes: [{ id: 'r' }, { id: 'a' }] })]]);
  end();
});

it('returns whether the tree in front is drawn', () => {
  expect(isTreeShown()).toBe(false);
  zoomIn();
  const end = shows('Main', recording());
  expect(isTreeShown()).toBe(true);
  useProjectStore.getState().setActiveTree('Dock');
  expect(isTreeShown()).toBe(false);
  useProjectStore.getState().setActiveTree('Main');
  end();
  expect(isTreeShown()).toBe(false);
});

it('keeps the newer view of a tree when the older one ends', () => {
  const end = shows('Main', recording());
  const newer = recording();
  const endNewer = shows('Main', newer);
  end();
  zoomIn();
  expect(newer.zoomIn).toHaveBeenCalledOnce();
  endNewer();
});

it('lead into a tree that is seen as a whole, and show that instead of all its blocks', () => {
  const main = recording();
  const [enter, show] = [vi.fn(), vi.fn()];
  const ends = [shows('Main', main), isTooLarge('Main', { fit: show, enter })];
  zoomIn();
  zoomReset();
  fit();
  expect(enter.mock.calls).toEqual([[], [1]]);
  expect(show).toHaveBeenCalledOnce();
  ends.push(isTooLarge('Main', { fit: show, enter: null }));
  zoomIn();
  expect(main.zoomIn).toHaveBeenCalledOnce();
  for (const end of ends) end();
  fit();
  expect(main.zoomTo).not.toHaveBeenCalled();
});
