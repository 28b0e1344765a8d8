import { act, renderHook, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { Part } from '@/model/nested';
import { useLiveStore } from '@/store/project/live';
import { forgetEditor } from '../../../../harness/canvas';
import type { Facts } from './facts';
import { usePainted } from './usePainted';

const box = { x: 0, y: 0, width: 80, height: 40 };
const parts: Part[] = [
  { id: 'r', box, title: 14, level: 1, piece: { box, blocks: ['a', 'b'], columns: 2, cell: 8 } },
];
const facts = new Map(
  ['r', 'a', 'b'].map((id): [string, Facts] => [
    id,
    { id, key: `Main/${id}`, node: { type: 'Sleep' }, family: 'action', hasError: false, isSelected: false },
  ]),
);

it('paints boxes and pieces, and no more after its end', async () => {
  forgetEditor();
  const root = document.createElement('div');
  root.innerHTML = '<div data-part="r"><i data-mark-of="r"></i><b data-piece="2"></b></div>';
  const [part, piece] = [root.querySelector('[data-part]')!, root.querySelector('[data-piece]')!];
  const [marks, hits, of] = [new Map(), new Set<string>(), { current: root }];
  const canvas = { current: document.createElement('canvas') };
  const { unmount } = renderHook(() =>
    usePainted(of, canvas, { parts, facts, marks, hits }, { width: 80, height: 40 }),
  );
  expect(part).toHaveAttribute('data-status', 'IDLE');
  expect(canvas.current.width).toBe(80 * (window.devicePixelRatio || 1));
  const set = (statuses: [string, 'RUNNING' | 'SUCCESS' | 'IDLE'][]) =>
    act(() => useLiveStore.setState({ statuses: new Map(statuses) }));
  set([
    ['Main/r', 'SUCCESS'],
    ['Main/b', 'RUNNING'],
  ]);
  await waitFor(() => expect(piece).toHaveAttribute('data-status', 'RUNNING'));
  expect(part).toHaveAttribute('data-status', 'SUCCESS');
  act(() => useLiveStore.setState({ statuses: new Map(), past: new Map([['Main/a', 'SUCCESS']]) }));
  await waitFor(() => expect(piece).toHaveAttribute('data-past', 'SUCCESS'));
  act(() => useLiveStore.setState({ faults: new Map([['Main/a', 'broken']]) }));
  await waitFor(() => expect(piece).toHaveAttribute('data-status', 'FAILURE'));
  unmount();
  act(() => useLiveStore.setState({ faults: new Map() }));
  await new Promise(requestAnimationFrame);
  expect(piece).toHaveAttribute('data-status', 'FAILURE');
});
