import { act, waitFor } from '@testing-library/react';
import type { ReactFlowInstance } from '@xyflow/react';
import { describe, expect, it, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { nodeOf } from '../../../../harness/testing';
import type { BlockNode, TreeEdge } from '../flow';
import { FIT, useViewport } from './useViewport';

const box = { x: 100, y: 40, width: 200, height: 44 };
const layoutOf = (width: number, height: number): Layout => ({ width, height, positions: { r: box } });
const diagram = (layout: Diagram['layout'] = 'vertical'): Diagram => ({
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: { r: { type: 'Sequence' } },
  layout,
});

let count = 0;
/** Returns the id of a tree that was never opened. */
const fresh = () => `Tree${(count += 1)}`;

/** Opens the view of a tree; returns the spies through which it sets the initial view. */
function begin(layout: Layout, tree = diagram(), id = fresh()) {
  const { used, view } = inFlow(() => useViewport(id, layout, tree));
  const flow = { fitView: vi.fn(() => Promise.resolve(true)), setViewport: view.setViewport };
  act(() => used().onInit(flow as unknown as ReactFlowInstance<BlockNode, TreeEdge>));
  return { fitView: flow.fitView, setViewport: flow.setViewport, used, id };
}

describe('the initial view', () => {
  it('is the whole tree if its names are readable then', () => {
    // The pane has 800 × 600 px: this is the smallest readable zoom, padding included.
    const { fitView, setViewport } = begin(layoutOf(800 / 0.6 / 1.14 - 1, 600 / 0.6 / 1.14 - 1));
    expect(fitView).toHaveBeenCalledExactlyOnceWith(FIT);
    expect(setViewport).not.toHaveBeenCalled();
  });

  it.each([
    ['wide', layoutOf(800 / 0.6 / 1.14 + 1, 100)],
    ['high', layoutOf(100, 600 / 0.6 / 1.14 + 1)],
  ])('is at the root of a tree that is too %s', (_, layout) => {
    const { fitView, setViewport } = begin(layout);
    expect(fitView).not.toHaveBeenCalled();
    const [to] = setViewport.mock.calls[0]!;
    expect(to.zoom).toBeCloseTo(0.7);
    expect(to.x).toBeCloseTo(400 - 200 * 0.7);
    expect(to.y).toBeCloseTo(48 - 40 * 0.7);
  });

  it('is at the left of a left-right tree', () => {
    const { setViewport } = begin(layoutOf(9000, 100), diagram('horizontal'));
    const [to] = setViewport.mock.calls[0]!;
    expect(to.x).toBeCloseTo(48 - 100 * 0.7);
    expect(to.y).toBeCloseTo(300 - 62 * 0.7);
  });

  it('has all drafts if there is no root', () => {
    const { fitView } = begin(layoutOf(9000, 9000), { ...diagram(), root: null });
    expect(fitView).toHaveBeenCalledOnce();
  });

  it('stays unchanged while the tree is empty', () => {
    const { fitView, setViewport, used } = begin({ width: 0, height: 0, positions: {} });
    expect(used().initial).toEqual({ x: 80, y: 80, zoom: 1 });
    expect(fitView).not.toHaveBeenCalled();
    expect(setViewport).not.toHaveBeenCalled();
  });

  it('is where the user looked last', () => {
    const { used, id } = begin(layoutOf(100, 100));
    used().onMoveEnd(null, { x: 1, y: 2, zoom: 0.5 });
    const again = begin(layoutOf(100, 100), diagram(), id);
    expect(again.used().initial).toEqual({ x: 1, y: 2, zoom: 0.5 });
    expect(again.fitView).not.toHaveBeenCalled();
    expect(again.setViewport).not.toHaveBeenCalled();
  });

  it('is that of a new tree for a tree of the same name in another project', () => {
    const { used, id } = begin(layoutOf(100, 100));
    used().onMoveEnd(null, { x: 1, y: 2, zoom: 0.5 });
    useProjectStore.setState({ projectId: 'another' });
    expect(begin(layoutOf(100, 100), diagram(), id).fitView).toHaveBeenCalledOnce();
  });
});

it('disconnects a block, and leaves it a little below where it is drawn', async () => {
  openDiagram({ root: 'r', nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } });
  const { used } = inFlow(() => useViewport('Main', layoutOf(1, 1), now.diagram()));
  act(() => used().cut('a', { ...layoutOf(1, 1), positions: { a: box } }));
  await waitFor(() => {
    expect(now.diagram().drafts).toEqual(['a']);
  });
  expect(nodeOf('Main', 'a')?.position).toEqual([100, 64]);
  expect(now.selection()).toEqual(['a']);
});
