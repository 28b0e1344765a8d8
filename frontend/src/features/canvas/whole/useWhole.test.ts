import { act } from '@testing-library/react';
import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { useTree } from '../useTree';
import { fit, zoomIn } from '../view/views';
import { useSeenWhole, useWhole } from './useWhole';

const treeOf = (count: number): Diagram => {
  const leaves = Array.from({ length: count }, (_, at) => `n${at}`);
  return {
    ...emptyDiagram('Main'),
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: leaves },
      ...Object.fromEntries(leaves.map((id) => [id, { type: 'Sleep' }])),
    },
  };
};
const open = (count: number) => {
  openDiagram(treeOf(count));
  return inFlow(() => {
    const tree = useTree('Main');
    return { ...useWhole('Main', tree), isSeen: useSeenWhole(tree.layout) };
  });
};

it('draws a tree as a whole that does not fit where its blocks can be distinguished, from a zoom on', () => {
  const { used, store } = open(200);
  expect(used().isWhole).toBe(false);
  act(() => store.setState({ transform: [0, 0, 0.24] }));
  expect([used().isWhole, used().isSeen]).toEqual([true, true]);
  act(() => store.setState({ transform: [0, 0, 0.26] }));
  expect(used().isWhole).toBe(false);
  const small = open(3);
  act(() => small.store.setState({ transform: [0, 0, 0.1] }));
  expect(small.used().isWhole).toBe(false);
});

it('shows the picture before the view moves, when the tree is fitted', () => {
  const { used, store } = open(200);
  act(fit);
  expect(used().isWhole).toBe(true);
  expect(used().isSeen).toBe(false);
  expect(store.getState().fitViewOptions).not.toHaveProperty('duration');
});

it('is left to the selected block by zooming in', () => {
  const { store, view } = open(200);
  act(() => store.setState({ transform: [0, 0, 0.02] }));
  act(zoomIn);
  expect(view.setViewport).toHaveBeenCalled();
  expect(view.scaleBy).not.toHaveBeenCalled();
  expect(now.selection()).toEqual(['r']);
});
