import { act, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { inFlow, openDiagram } from '../../../../harness/canvas';
import { useReveal } from './useReveal';
import type { Layout } from '@/model/layout';

const layout: Layout = {
  width: 900,
  height: 700,
  positions: {
    near: { x: 100, y: 100, width: 140, height: 44 },
    left: { x: 10, y: 100, width: 140, height: 44 },
    above: { x: 100, y: 20, width: 140, height: 44 },
    right: { x: 700, y: 100, width: 140, height: 44 },
    below: { x: 100, y: 500, width: 140, height: 44 },
  },
};
const store = () => useProjectStore.getState();

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: Object.keys(layout.positions) },
      ...Object.fromEntries(Object.keys(layout.positions).map((id) => [id, { type: 'Sleep' }])),
    },
  });
});

/** Opens a canvas of this size at the window's origin. */
function open(width = 800, height = 600, isWhole = false) {
  const canvas = document.createElement('div');
  canvas.dataset['tree'] = 'Main';
  canvas.getBoundingClientRect = () => new DOMRect(0, 0, width, height);
  Object.defineProperty(canvas, 'clientWidth', { value: width, configurable: true });
  document.body.append(canvas);
  onTestFinished(() => canvas.remove());
  return inFlow(() => useReveal('Main', layout, isWhole));
}

describe('a requested block', () => {
  it('moves to the middle, at a readable zoom', async () => {
    const { view } = open();
    act(() => store().reveal('Main', 'near'));
    await waitFor(() => {
      expect(view.setViewport).toHaveBeenCalledOnce();
    });
    const [to, how] = view.setViewport.mock.calls[0]!;
    expect(to).toEqual({ x: 800 / 2 - 170, y: 600 / 2 - 122, zoom: 1 });
    expect(how).toMatchObject({ duration: 200 });
  });

  it('is magnified if the view is zoomed out', async () => {
    const { view, store: flow } = open();
    act(() => flow.setState({ transform: [0, 0, 0.2] }));
    act(() => store().reveal('Main', 'near'));
    await waitFor(() => {
      expect(view.setViewport.mock.calls[0]?.[0].zoom).toBe(0.9);
    });
  });

  it('waits for the canvas, which has no size before its tab is in front', async () => {
    const { view } = open(0, 0);
    act(() => store().reveal('Main', 'near'));
    for (let count = 0; count < 5; count += 1) await new Promise(requestAnimationFrame);
    expect(view.setViewport).not.toHaveBeenCalled();
    Object.defineProperty(document.querySelector('[data-tree]'), 'clientWidth', { value: 800 });
    await waitFor(() => {
      expect(view.setViewport).toHaveBeenCalledOnce();
    });
  });

  it('does not move the view of another tree', () => {
    const { view } = open();
    act(() => store().reveal('Other', 'near'));
    act(() => store().reveal('Main', 'gone'));
    expect(view.setViewport).not.toHaveBeenCalled();
  });
});

describe('a block that is selected by keys', () => {
  it.each([
    ['left', { x: 38, y: 0 }],
    ['above', { x: 0, y: 28 }],
    ['right', { x: -88, y: 0 }],
    ['below', { x: 0, y: -28 }],
  ])('is moved just into view from %s', async (id, by) => {
    const { view } = open();
    act(() => store().select('Main', [id]));
    await waitFor(() => {
      expect(view.setViewport).toHaveBeenCalledOnce();
    });
    expect(view.setViewport.mock.calls[0]).toEqual([{ ...by, zoom: 1 }, { duration: 120 }]);
  });

  it('moves nothing if it is visible, or if the canvas has no size', () => {
    const { view } = open();
    act(() => store().select('Main', ['near']));
    act(() => store().select('Main', []));
    act(() => store().select('Main', ['gone']));
    expect(view.setViewport).not.toHaveBeenCalled();
  });

  it('moves nothing on a hidden canvas', () => {
    const { view } = open(0, 0);
    act(() => store().select('Main', ['below']));
    expect(view.setViewport).not.toHaveBeenCalled();
  });
});

describe('a tree that is seen as a whole', () => {
  it('is left for a block that is asked for, and not to follow the run or the keys', async () => {
    const { view } = open(800, 600, true);
    act(() => store().select('Main', ['below']));
    const following = { tree: 'Main', node: 'near', count: 7 };
    act(() => useProjectStore.setState({ revealed: following }));
    expect(view.setViewport).not.toHaveBeenCalled();
    act(() => store().reveal('Main', 'near'));
    await waitFor(() => expect(view.setViewport).toHaveBeenCalledOnce());
  });
});
