import { screen, within } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../harness/canvas';
import { nodeOf, show, user } from '../../../harness/testing';
import { MergeConflicts } from './MergeConflicts';

const open = (conflicts: unknown) =>
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', ports: { msec: '2' } } },
    conflicts,
  });
const panel = () => screen.getByTestId('merge-conflicts');

beforeEach(() => {
  open([
    { op: 'change', node: 'a', field: 'ports.msec', base: '1', ours: '2', theirs: '<b>3</b>' },
    { op: 'rename', node: '', base: null, ours: null, theirs: 'x' },
  ]);
});

it('shows both sides of each decision', () => {
  show(<MergeConflicts treeId="Main" />);
  expect(panel()).toHaveAccessibleName('A merge has left 2 decisions');
  const [first, second] = within(panel()).getAllByRole('listitem');
  expect(first).toHaveTextContent('Sleep · msecBefore1Ours2Keep oursTheirs<b>3</b>Take theirs');
  expect(second).toHaveTextContent('The tree itself · nameBeforenothingOursnothing');
});

it('takes a side, which undo takes back', async () => {
  show(<MergeConflicts treeId="Main" />);
  await user.click(within(panel()).getAllByRole('button', { name: 'Take theirs' })[0]!);
  expect(nodeOf('Main', 'a')?.ports).toEqual({ msec: '<b>3</b>' });
  expect(panel()).toHaveAccessibleName('A merge has left 1 decision');
  await user.click(within(panel()).getByRole('button', { name: 'Keep ours' }));
  expect(screen.queryByTestId('merge-conflicts')).toBeNull();
  expect(now.diagram()).not.toHaveProperty('conflicts');
});

it('is not there without decisions, and only to look at for viewers', () => {
  useProjectStore.setState({ role: 'viewer' });
  show(<MergeConflicts treeId="Main" />);
  for (const button of within(panel()).getAllByRole('button')) expect(button).toBeDisabled();
  useProjectStore.setState({ role: 'owner' });
});
