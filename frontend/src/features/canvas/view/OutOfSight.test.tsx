import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { layoutTree } from '@/model/layout';
import { vocabulary } from '@/model/testing';
import { showInFlow } from '../../../../harness/canvas';
import { OutOfSight } from './OutOfSight';

const diagram: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } },
};
const button = () => screen.queryByRole('button', { name: 'Back to the tree' });

it('is there while no block is in view, and shows the whole tree', async () => {
  const onBack = vi.fn();
  const layout = layoutTree(diagram, vocabulary);
  const { store } = showInFlow(<OutOfSight layout={layout} onBack={onBack} />);
  expect(button()).toBeNull();
  for (const [x, y] of [
    [2000, 0],
    [0, 2000],
    [-2000, 0],
    [0, -2000],
  ] as const) {
    act(() => store.setState({ transform: [x, y, 1] }));
    expect(button()).toBeInTheDocument();
    act(() => store.setState({ transform: [0, 0, 1] }));
    expect(button()).toBeNull();
  }
  act(() => store.setState({ transform: [2000, 0, 1] }));
  fireEvent.click(button()!);
  expect(onBack).toHaveBeenCalledOnce();
  await waitFor(() => expect(store.getState().fitViewOptions).toMatchObject({ duration: 200 }));
});

it('is not there for a tree without blocks', () => {
  const { store } = showInFlow(
    <OutOfSight layout={layoutTree(emptyDiagram('MainTree'), vocabulary)} onBack={vi.fn()} />,
  );
  act(() => store.setState({ transform: [2000, 0, 1] }));
  expect(button()).toBeNull();
});
