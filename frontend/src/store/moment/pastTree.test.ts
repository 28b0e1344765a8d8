import { expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { oneBlock } from '../testing';
import type { Moment } from '../recording/types';
import { openPastTree, selectPast, shownTree, usePastTree } from './pastTree';
import { atPresent, useMoment } from './store';

it('shows the chosen tree, else the one that is edited, else the main one', () => {
  expect(shownTree('B', ['A', 'B'], 'A')).toBe('B');
  expect(shownTree('gone', ['A', 'B'], 'B')).toBe('B');
  expect(shownTree(null, ['A', 'B'], 'new')).toBe('A');
  expect(shownTree(null, [], 'new')).toBeNull();
});

it('selects the same block of the present where it exists', () => {
  openProject({ texts: { 'trees/Main.json': oneBlock('Main', 'AlwaysSuccess') } });
  selectPast('Main', 'n1');
  expect(useProjectStore.getState()).toMatchObject({ activeTree: 'Main', selection: ['n1'] });
  selectPast('Gone', 'n7');
  expect(usePastTree.getState()).toMatchObject({ tree: 'Gone', node: 'n7' });
  expect(useProjectStore.getState()).toMatchObject({ activeTree: 'Main', selection: [] });
});

it('follows what leads to a block of the run', () => {
  openProject({ texts: { 'trees/Main.json': oneBlock('Main', 'AlwaysSuccess') } });
  onTestFinished(() => useMoment.setState(atPresent));
  const diagram = useProjectStore.getState().diagrams['Main']!;
  useMoment.setState({ shown: {} as Moment, trees: { Main: { diagram, isAttached: true } } });
  useProjectStore.getState().reveal('Main', 'n9');
  expect(usePastTree.getState().node).not.toBe('n9');
  useProjectStore.getState().reveal('Main', 'n1');
  expect(usePastTree.getState()).toMatchObject({ tree: 'Main', node: 'n1' });
});

it('forgets in the present what was chosen of the past', () => {
  onTestFinished(() => useMoment.setState(atPresent));
  useMoment.setState({ shown: {} as Moment });
  openPastTree('Main');
  useMoment.setState({ shown: null });
  expect(usePastTree.getState().tree).toBeNull();
});
