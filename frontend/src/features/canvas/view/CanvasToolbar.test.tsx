import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { now, openDiagram, showInFlow } from '../../../../harness/canvas';
import { nodeOf, user } from '../../../../harness/testing';
import { CanvasToolbar } from './CanvasToolbar';
import { FIT } from './useViewport';
import { isTreeShown } from './views';

let flow: ReturnType<typeof showInFlow>;
const button = (name: string | RegExp) => screen.getByRole('button', { name });
const press = (name: string | RegExp) => user.click(button(name));
const manyBlocks = Object.fromEntries(Array.from({ length: 15 }, (_, at) => [`n${at}`, { type: 'Sleep' }]));

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', position: [900, 900] } },
  });
  flow = showInFlow(<CanvasToolbar treeId="Main" />);
});

describe('the zoom', () => {
  it('is shown in percent, and can be reset to 100', async () => {
    act(() => flow.store.setState({ transform: [0, 0, 0.456] }));
    expect(button('46% · Zoom to 100 %')).toHaveTextContent('46%');
    await press(/Zoom to 100/);
    expect(flow.view.scaleTo).toHaveBeenCalledExactlyOnceWith(1, { duration: 120 });
  });

  it('can be increased and decreased', async () => {
    await press('Zoom in');
    expect(flow.view.scaleBy).toHaveBeenLastCalledWith(1.2, { duration: 120 });
    await press('Zoom out');
    expect(flow.view.scaleBy).toHaveBeenLastCalledWith(1 / 1.2, { duration: 120 });
  });

  it('fits the tree, or the selection', async () => {
    expect(screen.queryByRole('button', { name: /selection/ })).toBeNull();
    await press('Show the whole tree (Shift+1)');
    expect(flow.store.getState().fitViewOptions).toEqual({ ...FIT, duration: 200 });
    act(() => useProjectStore.getState().select('Main', ['a']));
    await press('Zoom to the selection (Shift+2)');
    expect(flow.store.getState().fitViewOptions).toMatchObject({ nodes: [{ id: 'a' }] });
    act(() => useProjectStore.getState().select('Other', ['a']));
    expect(screen.queryByRole('button', { name: /selection/ })).toBeNull();
  });
});

describe('the layout', () => {
  it('is tidied, and then shown as a whole', async () => {
    await press('Tidy layout');
    expect(nodeOf('Main', 'a')?.position).toBeUndefined();
    await waitFor(() => {
      expect(flow.store.getState().fitViewOptions).toEqual({ ...FIT, duration: 200 });
    });
  });

  it('changes to left-right, and back', async () => {
    await press('Left-right layout');
    expect(now.diagram().layout).toBe('horizontal');
    expect(screen.queryByRole('button', { name: 'Left-right layout' })).toBeNull();
    await press('Top-down layout');
    expect(now.diagram().layout).toBe('vertical');
  });
});

describe('the overview', () => {
  it('is on for trees of more than fourteen blocks, until the user decides', async () => {
    expect(button('Overview')).toHaveAttribute('aria-pressed', 'false');
    act(() =>
      useProjectStore
        .getState()
        .apply('Main', 'add', [(draft) => void Object.assign(draft.nodes, manyBlocks)]),
    );
    expect(button('Overview')).toHaveAttribute('aria-pressed', 'true');
    await press('Overview');
    expect(now.editor().minimap).toBe(false);
    expect(button('Overview')).toHaveAttribute('aria-pressed', 'false');
    await press('Overview');
    expect(now.editor().minimap).toBe(true);
  });
});

it('opens the search', async () => {
  await press('Find (Ctrl+F)');
  expect(now.editor().find).toBe(true);
});

it('registers its view for the view commands', () => {
  expect(isTreeShown()).toBe(true);
  flow.unmount();
  expect(isTreeShown()).toBe(false);
});

it('is a single button on a small canvas, which opens the tools', async () => {
  act(() => flow.store.setState({ width: 390, height: 600 }));
  expect(screen.getAllByRole('button')).toHaveLength(1);
  expect(button('Show the tools of the view')).toHaveAttribute('aria-expanded', 'false');
  await press('Show the tools of the view');
  expect(button('Tidy layout')).toBeInTheDocument();
  await press('Hide the tools of the view');
  expect(screen.getAllByRole('button')).toHaveLength(1);
  act(() => flow.store.setState({ width: 900, height: 300 }));
  expect(screen.getAllByRole('button')).toHaveLength(1);
  act(() => flow.store.setState({ width: 900, height: 600 }));
  expect(button('Tidy layout')).toBeInTheDocument();
  expect(screen.queryByTestId('toolbar-toggle')).toBeNull();
});
