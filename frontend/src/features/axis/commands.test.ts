import { afterEach, expect, it } from 'vitest';
import { openProject } from '../../../harness/testing';
import { treeNode } from '../../../harness/running';
import { useCommandTable } from '@/commands/registry';
import { selectPast } from '@/store/moment/pastTree';
import { useMoment, atPresent } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { registerAxisCommands, selectedUid } from './commands';

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
});

it('offers the way back only while somebody looks back', () => {
  const unregister = registerAxisCommands();
  const isEnabled = (id: string) => useCommandTable.getState().commands[id]!.enabled!();
  expect(isEnabled('time.live')).toBe(false);
  expect(isEnabled('time.tickBack')).toBe(false);
  useMoment.setState({ t: 1 });
  expect(isEnabled('time.live')).toBe(true);
  unregister();
});

it('finds the selected block in the tree that is shown', () => {
  openProject({ trees: { Main: { n1: { type: 'Sequence' } } }, selected: ['n1'] });
  expect(selectedUid()).toBeNull();
  useSessionStore.setState({ tree: [treeNode(1, 0, 'a')] });
  expect(selectedUid()).toBe(1);
  useMoment.setState({ t: 1, tree: [{ ...treeNode(4, 0, 'a'), node_id: 'n1', ports: {} }] });
  expect(selectedUid()).toBe(4);
  const gone = { ...treeNode(5, 0, 'b'), tree_id: 'Gone', ports: {} };
  useMoment.setState({ tree: [gone] });
  selectPast('Gone', gone.node_id);
  expect(selectedUid()).toBe(5);
});
