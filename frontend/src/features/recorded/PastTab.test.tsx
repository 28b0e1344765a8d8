import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { openDiagram, showDrawn } from '../../../harness/canvas';
import { user } from '../../../harness/testing';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { usePastTree } from '@/store/moment/pastTree';
import { FOREIGN_TREE } from '@/store/moment/recordedTrees';
import { atPresent, useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { usePastLive } from '@/store/project/live';
import type { Moment, RecordedNode } from '@/store/recording/types';
import { PastTab } from './PastTab';

const node = (uid: number, parent: number, type: string, tree = 'Main'): RecordedNode => ({
  ...{ uid, parent, type, kind: 'action', name: type, path: type, node_id: `n${uid}`, tree_id: tree },
  ports: type === 'Wave' ? { hand: 'left' } : {},
});
const nodes = [node(1, 0, 'Sequence'), node(2, 1, 'Wave'), node(3, 1, 'SubTree'), node(4, 3, 'Bow', 'Leg')];
const main: Diagram = {
  ...emptyDiagram('Main'),
  root: 'n1',
  nodes: {
    n1: { type: 'Sequence', children: ['n2', 'n3'] },
    n2: { type: 'Wave', ports: { hand: 'left' } },
    n3: { type: 'SubTree', tree: 'Leg' },
  },
};
const leg: Diagram = { ...emptyDiagram('Leg'), root: 'n4', nodes: { n4: { type: 'Bow' } } };
const moment = { t: 2.5, statuses: [[2, 'RUNNING']], flashes: [] } as unknown as Moment;

beforeEach(() => {
  Element.prototype.checkVisibility = () => true;
  openDiagram({ ...main, nodes: { n1: { type: 'Sequence' } } });
  onTestFinished(() => act(() => useMoment.setState(atPresent, true)));
});

const recorded = (...diagrams: Diagram[]) =>
  Object.fromEntries(diagrams.map((diagram) => [diagram.id, { diagram, isAttached: true }]));

function look(trees = recorded(main, leg)) {
  usePastLive.getState().setTree(nodes);
  usePastLive.getState().setStatuses([[2, 'RUNNING']]);
  useMoment.setState({ t: 2.5, shown: moment, tree: nodes, trees });
  return showDrawn(<PastTab />);
}
const block = (id: string) => screen.getByTestId(`node-${id}`);

it('shows the tree of the recording with its statuses, also what the project does not have any more', async () => {
  await look();
  expect(screen.getByText('As it ran, at 2.50 s')).toBeInTheDocument();
  expect(block('n2')).toHaveAttribute('data-status', 'RUNNING');
  expect(block('n2')).toHaveAttribute('data-family', 'action');
  expect(block('n2')).toHaveTextContent('left');
});

it('selects blocks by a click and by keys, and says what their ports were given', async () => {
  await look();
  fireEvent.click(block('n1'));
  fireEvent.keyDown(screen.getByTestId('recorded-canvas'), { key: 'ArrowDown' });
  expect(usePastTree.getState()).toMatchObject({ tree: 'Main', node: 'n2' });
  expect(screen.getByTestId('past-details')).toHaveTextContent('Waverunninghand = left');
  expect(useProjectStore.getState().selection).toEqual([]);
});

it('does not change the tree of the project', async () => {
  await look();
  const before = useProjectStore.getState().diagrams;
  fireEvent.click(block('n1'));
  for (const key of ['Delete', 'F2', ' ', 'Tab', 'a'])
    fireEvent.keyDown(screen.getByTestId('recorded-canvas'), { key });
  expect(useProjectStore.getState().diagrams).toBe(before);
  expect(screen.queryByTitle('Add a child')).toBeNull();
});

it('opens the tree of a SubTree', async () => {
  await look();
  fireEvent.doubleClick(block('n3'));
  expect(await screen.findByTestId('node-n4')).toBeInTheDocument();
  expect(screen.getByRole('combobox', { name: 'Tree of the run' })).toHaveValue('Leg');
});

it('returns to the present to edit, but has nothing to edit of a foreign log', async () => {
  await look();
  await user.click(screen.getByRole('button', { name: 'Edit' }));
  expect(useMoment.getState().t).toBeNull();
  expect(screen.getByText(/while you look back/)).toBeInTheDocument();
  act(() => useMoment.setState({ t: 1, shown: moment, trees: recorded({ ...leg, id: FOREIGN_TREE }) }));
  expect(screen.queryByRole('button', { name: 'Edit' })).toBeNull();
});

it('says that nothing was recorded of a tree', async () => {
  await look({});
  expect(screen.getByText('The recording has no tree at this moment.')).toBeInTheDocument();
});

it('marks and lists what changed since', async () => {
  await look();
  await user.click(screen.getByRole('button', { name: 'Compare with now' }));
  expect(screen.getByTestId('past-since')).toHaveTextContent('2 blocks changed since the run.');
  expect(block('n2').closest('.react-flow__node')?.className).toMatch(/mark_removed/);
  expect(screen.getAllByRole('listitem').filter(({ dataset }) => dataset['kind'] === 'removed')).toHaveLength(
    2,
  );
  act(() => useProjectStore.setState({ diagrams: { Main: main } }));
  expect(screen.getByTestId('past-since')).toHaveTextContent('Nothing changed in this tree');
});
