import { fireEvent, screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, it, vi } from 'vitest';
import { openDiagram, showDrawn } from '../../../harness/canvas';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { ReadOnlyCanvas } from './ReadOnlyCanvas';

const diagram: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 's'] },
    a: { type: 'Sleep' },
    s: { type: 'SubTree', tree: 'B' },
  },
};

beforeEach(() => {
  Element.prototype.checkVisibility = () => true;
  openDiagram(diagram);
});

it('marks blocks, selects and opens them, and offers no place for new ones', async () => {
  const [onSelect, onOpen] = [vi.fn(), vi.fn()];
  await showDrawn(
    <ReadOnlyCanvas
      diagram={diagram}
      vocabulary={useProjectStore.getState().vocabulary}
      label="then"
      selected="r"
      onSelect={onSelect}
      onOpen={onOpen}
      marks={new Map([['a', 'removed']])}
    />,
  );
  const canvas = screen.getByRole('application', { name: 'then' });
  expect(screen.getByTestId('node-r')).toHaveAttribute('data-selected', 'true');
  expect(screen.getByTestId('node-a').closest('.react-flow__node')?.className).toMatch(/mark_removed/);
  for (const key of ['ArrowDown', 'Home', 'x']) fireEvent.keyDown(canvas, { key });
  expect(onSelect.mock.calls).toEqual([['a'], ['r']]);
  fireEvent.keyDown(canvas, { key: 'Enter' });
  expect(onOpen).toHaveBeenCalledWith('r');
  fireEvent.doubleClick(screen.getByTestId('node-s'));
  expect(onOpen).toHaveBeenCalledWith('s');
  expect(canvas.querySelector('[class*="plus"]')).toBeNull();
});

it('draws a tree that does not fit as a whole, whose blocks can be pressed', async () => {
  const leaves = Array.from({ length: 140 }, (_, index) => `n${index}`);
  const wide: Diagram = {
    ...emptyDiagram('Main'),
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: leaves },
      ...Object.fromEntries(leaves.map((id) => [id, { type: 'Sleep' }])),
    },
  };
  const onSelect = vi.fn();
  await showDrawn(
    <ReadOnlyCanvas
      diagram={wide}
      vocabulary={useProjectStore.getState().vocabulary}
      label="then"
      selected={null}
      onSelect={onSelect}
      onOpen={vi.fn()}
      marks={new Map()}
    />,
  );
  expect(await screen.findByTestId('whole-tree')).toBeInTheDocument();
  expect(screen.getByTestId('node-n7')).toBeEmptyDOMElement();
  const tree = screen.getByRole('tree', { name: 'The whole of Main' });
  fireEvent.click(tree, { clientX: 5, clientY: 5 });
  expect(onSelect).toHaveBeenCalledWith('r');
  await waitFor(() => expect(screen.queryByTestId('whole-tree')).toBeNull());
});
