import { act, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { addNode, setLayout } from '@/model/edits';
import { toggleExpanded } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { usePresentation } from '@/workspace/presentation';
import { inFlow, openDiagram, PANE } from '../../../../harness/canvas';
import { useTree } from '../useTree';
import { toggleCompact } from './compact';
import { useRefit } from './useRefit';

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['s', 'a'] },
        s: { type: 'SubTree', tree: 'Dock' },
        a: { type: 'Sleep' },
      },
    },
    { texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') } },
  );
});

function begin() {
  const { store, view } = inFlow(() => useRefit(useTree('Main')));
  const wish = () => store.getState().fitViewOptions;
  return { store, view, wish };
}

describe('the view is fitted again', () => {
  it('when the orientation changes', async () => {
    const { wish } = begin();
    expect(wish()).toBeUndefined();
    act(() => useProjectStore.getState().apply('Main', 'orientation', [setLayout('horizontal')]));
    await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
  });

  it('when the layout becomes compact', async () => {
    const { wish } = begin();
    act(toggleCompact);
    await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
    act(toggleCompact);
  });

  it('when a subtree is expanded: to all if it is readable then', async () => {
    const { wish } = begin();
    act(() => toggleExpanded('Main', 's'));
    await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
    expect(wish()).not.toHaveProperty('nodes');
  });

  it('when a subtree of a large tree is expanded: to that subtree', async () => {
    const { store, wish } = begin();
    act(() => store.setState({ width: 200, height: 150 }));
    act(() => toggleExpanded('Main', 's'));
    await waitFor(() => expect(wish()?.nodes).toEqual([{ id: 's' }, { id: 's n1' }]));
  });

  it('when a smaller canvas does not show all of it any more', async () => {
    const { store, wish } = begin();
    act(() => store.setState({ transform: [250, 20, 1] }));
    act(() => store.setState({ width: 780 }));
    expect(wish()).toBeUndefined();
    act(() => store.setState({ width: 200 }));
    await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
  });
});

const growBy = (count: number) =>
  act(() => {
    for (let n = 0; n < count; n++)
      useProjectStore
        .getState()
        .apply('Main', 'add', [addNode(`n${n}`, { type: 'Sleep' }, { at: 'child', parent: 'r', index: 0 })]);
  });

describe('a tree that grows', () => {
  it('is kept in view', async () => {
    const { store, wish } = begin();
    act(() => store.setState({ transform: [250, 20, 1] }));
    growBy(4);
    await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
  });

  it('stays where it is if a part of it was out of sight before', () => {
    const { store, wish } = begin();
    act(() => store.setState({ transform: [-900, 20, 1] }));
    growBy(4);
    expect(wish()).toBeUndefined();
  });

  it('is not made so small that its names cannot be read', () => {
    const { store, wish } = begin();
    act(() => store.setState({ transform: [250, 20, 1] }));
    growBy(40);
    expect(wish()).toBeUndefined();
  });
});

it('the first block is shown in the middle', async () => {
  openDiagram({ root: null, nodes: {} });
  const { wish } = begin();
  act(() =>
    useProjectStore.getState().apply('Main', 'add', [addNode('a', { type: 'Sleep' }, { at: 'root' })]),
  );
  await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
});

it('is fitted to the last of several sizes that follow each other, as an edge is dragged', async () => {
  const { store, wish } = begin();
  act(() => store.setState({ transform: [250, 20, 1] }));
  act(() => store.setState({ width: 200 }));
  await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
  // On its way to the whole tree the view shows a part of it.
  act(() => store.setState({ transform: [120, 20, 0.9], fitViewOptions: undefined }));
  act(() => store.setState({ width: 150 }));
  await waitFor(() => expect(wish()).toMatchObject({ duration: 200 }));
});

it('but not if the user looked at a part', () => {
  const { store, wish } = begin();
  act(() => store.setState({ transform: [-500, 20, 1] }));
  act(() => store.setState({ width: 200 }));
  expect(wish()).toBeUndefined();
});

describe('a presentation', () => {
  const resize = (store: ReturnType<typeof begin>['store'], width: number, height: number) =>
    act(() => store.setState({ width, height }));

  it('shows the whole tree enlarged, and gives the view of before back', async () => {
    onTestFinished(() => usePresentation.setState(usePresentation.getInitialState(), true));
    const { store, view, wish } = begin();
    act(() => store.setState({ transform: [12, 34, 0.9] }));
    act(() => usePresentation.setState({ mode: 'tree' }));
    resize(store, 1600, 900);
    await waitFor(() => expect(wish()).toMatchObject({ maxZoom: 2 }));
    act(() => usePresentation.setState({ mode: 'off' }));
    resize(store, PANE.width, PANE.height);
    await waitFor(() =>
      expect(view.setViewport).toHaveBeenCalledWith({ x: 12, y: 34, zoom: 0.9 }, undefined),
    );
  });
});
