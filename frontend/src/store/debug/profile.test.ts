import { afterEach, expect, it, onTestFinished } from 'vitest';
import type { NodeTime, TreeNode } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openSession } from '../../../harness/testing';
import { followHeat, heatOf, measure, sample, useProfile } from './profile';

const node = (uid: number, node_id: string): TreeNode => ({
  uid,
  parent: uid - 1,
  type: 'Act',
  kind: 'Action',
  name: node_id,
  path: `p/${node_id}`,
  node_id,
  tree_id: 'Main',
});
const tree = [node(1, 'r'), node(2, 'a'), node(3, 'a')];
const time = (uid: number, self_ms: number): NodeTime => ({ uid, calls: 1, total_ms: self_ms, self_ms });
const profile = {
  on: true,
  ticks: 1,
  tick_ms: 10,
  nodes: [time(1, 1), time(2, 3), time(3, 4)],
  sample: null,
  samples: 0,
  stacks: [],
};
const heat = () => Object.fromEntries(useProfile.getState().heat);

afterEach(() => {
  useMoment.setState(atPresent);
  useSessionStore.setState(initialSession);
});

it('counts all instances of a block together, in steps of 1 %, and passes over unknown nodes', () => {
  expect(Object.fromEntries(heatOf(tree, [...profile.nodes, time(9, 5)], 10))).toEqual({
    'Main/r': 0.1,
    'Main/a': 0.7,
  });
  expect([...heatOf(tree, [time(1, 1)], 3).values()]).toEqual([0.33]);
});

it('shows heat only while nodes are measured, and only of the present', () => {
  onTestFinished(followHeat());
  expect(heat()).toEqual({});
  useSessionStore.setState({ tree, profile });
  expect(heat()).toEqual({ 'Main/r': 0.1, 'Main/a': 0.7 });
  useMoment.setState({ t: 3 });
  expect(heat()).toEqual({});
  useMoment.setState(atPresent);
  expect(heat()).not.toEqual({});
  useSessionStore.setState({ profile: { ...profile, on: false } });
  expect(heat()).toEqual({});
});

it('forgets what was asked for with its session', () => {
  onTestFinished(followHeat());
  useSessionStore.setState({ introspection: { role: 'driver' } as never });
  useProfile.setState({ isWanted: true });
  useSessionStore.setState({ introspection: null });
  expect(useProfile.getState().isWanted).toBe(false);
});

it('asks the session to measure all nodes, or to sample one leaf too', async () => {
  const { sent } = await openSession();
  void measure(true);
  void sample(tree[1]!);
  void measure(false);
  expect(sent.filter(({ command }) => command === 'profile').map(({ data }) => data)).toEqual([
    { on: true },
    { on: true, sample: 2, path: 'p/a' },
    { on: false },
  ]);
  expect(useProfile.getState().isWanted).toBe(false);
});
