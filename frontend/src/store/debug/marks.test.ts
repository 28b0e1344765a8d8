import { expect, it, onTestFinished } from 'vitest';
import type { Forced, Held, TreeNode } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { followMarks, useDebugMarks } from './marks';

const node = (uid: number, node_id: string): TreeNode => ({
  uid,
  parent: 0,
  type: 'Sleep',
  kind: '',
  name: node_id,
  path: node_id,
  node_id,
  tree_id: 'Main',
});
const tree = [node(1, 'r'), node(2, 'a'), node(3, 'b'), node(4, 'c')];
const held = { uid: 2, path: [1, 2], ahead: [2, 3] } as unknown as Held;
const forced: Forced = {
  nodes: [{ uid: 3, status: 'FAILURE', once: true, after: false, skips_to: 0 }],
  alone: 4,
};

it('marks where the tree is held and what is forced now', () => {
  onTestFinished(() => {
    useMoment.setState(atPresent);
    useSessionStore.setState(initialSession);
  });
  onTestFinished(followMarks());
  useSessionStore.setState({ tree, held, forced });
  const marks = useDebugMarks.getState();
  expect([...marks.held]).toEqual(
    expect.arrayContaining([
      ['Main/r', 'path'],
      ['Main/a', 'here'],
      ['Main/b', 'ahead'],
    ]),
  );
  expect(marks.held.get('Main/c')).toBeUndefined();
  expect(marks.forced.get('Main/b')).toMatchObject({ status: 'FAILURE', once: true, alone: false });
  expect(marks.forced.get('Main/c')).toMatchObject({ alone: true });
  useMoment.setState({ t: 3 });
  expect(useDebugMarks.getState().held.size + useDebugMarks.getState().forced.size).toBe(0);
  useMoment.setState(atPresent);
  expect(useDebugMarks.getState().held.size).toBe(3);
  useSessionStore.setState({ held: null, forced: null });
  expect(useDebugMarks.getState().held.size + useDebugMarks.getState().forced.size).toBe(0);
});

it('marks the block whose Python is held, as at a hold at a block', () => {
  onTestFinished(() => useSessionStore.setState(initialSession));
  onTestFinished(followMarks());
  useSessionStore.setState({ tree, heldInPython: { uid: 3, path: [1, 3], tick: 2, statuses: [] } });
  expect([...useDebugMarks.getState().held]).toEqual([
    ['Main/r', 'path'],
    ['Main/b', 'here'],
  ]);
  useSessionStore.setState({ heldInPython: null });
  expect(useDebugMarks.getState().held.size).toBe(0);
});

it('marks in the past the blocks whose result was forced in the shown tick', () => {
  onTestFinished(() => useMoment.setState(atPresent));
  onTestFinished(followMarks());
  const shown = { forced: [2, 3], statuses: [[3, 'RUNNING']], flashes: [[2, 'FAILURE']] };
  const look = (moment: unknown) =>
    useMoment.setState({ t: 1, tree, shown: moment } as unknown as ReturnType<typeof useMoment.getState>);
  look(shown);
  const marks = () => [...useDebugMarks.getState().forced];
  expect(marks().map(([key, { status }]) => [key, status])).toEqual([
    ['Main/a', 'FAILURE'],
    ['Main/b', 'RUNNING'],
  ]);
  look({ ...shown, forced: [] });
  expect(marks()).toEqual([]);
});
