import { beforeEach, expect, it, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { layoutTree } from '@/model/layout';
import { inFlow } from '../../../../harness/canvas';
import { useEnter } from './useEnter';

const diagram: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: { r: { type: 'Sequence', children: ['a'], collapsed: true }, a: { type: 'Sleep' } },
};
const layout = layoutTree(diagram);
const onEntered = vi.fn();
const reduced = (matches: boolean) =>
  vi
    .spyOn(window, 'matchMedia')
    .mockImplementation(
      () =>
        ({ matches, addEventListener: vi.fn(), removeEventListener: vi.fn() }) as unknown as MediaQueryList,
    );

beforeEach(() => onEntered.mockReset());

it('shows the last step of the way to a block, or to the one that hides it', () => {
  reduced(false);
  const { used, view } = inFlow(() => useEnter({ diagram, layout }, onEntered));
  used()('a');
  const [from, to] = view.setViewport.mock.calls.map(([viewport]) => viewport.zoom);
  expect(from).toBeLessThan(to!);
  expect(from).toBeGreaterThan(0.4);
  expect(view.setViewport.mock.lastCall?.[1]).toEqual({ duration: 200 });
  expect(onEntered).toHaveBeenCalledExactlyOnceWith('r');
});

it('goes to the root without a block, at once for a user who wants no motion', () => {
  reduced(true);
  const { used, view } = inFlow(() => useEnter({ diagram, layout }, onEntered));
  used()(null, 0.8);
  expect(view.setViewport).toHaveBeenCalledOnce();
  expect(view.setViewport.mock.calls[0]?.[0].zoom).toBe(0.8);
  expect(onEntered).toHaveBeenCalledWith('r');
  used()('gone');
  expect(view.setViewport).toHaveBeenCalledOnce();
});
