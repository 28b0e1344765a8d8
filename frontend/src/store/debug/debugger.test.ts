import { beforeEach, expect, it, onTestFinished } from 'vitest';
import type { Held, TreeNode } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openSession, type FakeExecutor } from '../../../harness/testing';
import {
  canDebug,
  canForce,
  force,
  instanceOf,
  nodeOf,
  nodesOf,
  release,
  stepTick,
  stepTo,
} from './debugger';

const debugged = ({ sent }: FakeExecutor) =>
  sent.filter(({ command }) => ['force', 'release', 'step_to'].includes(command));

const node = (uid: number, parent: number, tree_id: string, node_id: string, type = 'Sleep'): TreeNode => ({
  uid,
  parent,
  type,
  kind: '',
  name: node_id,
  path: `${uid}`,
  node_id,
  tree_id,
});
// Main calls Dock twice.
const tree = [
  node(1, 0, 'Main', 'r', 'Sequence'),
  node(2, 1, 'Main', 's1', 'SubTree'),
  node(3, 2, 'Dock', 'd'),
  node(4, 1, 'Main', 's2', 'SubTree'),
  node(5, 4, 'Dock', 'd'),
];

beforeEach(() => {
  onTestFinished(() => useSessionStore.setState(initialSession));
});

it('is controlled by the driver alone', () => {
  const introspection = { role: 'driver' } as never;
  useSessionStore.setState({ executor: 'held', introspection });
  expect([canDebug(), canForce()]).toEqual([true, true]);
  useSessionStore.setState({ introspection: { role: 'viewer' } as never });
  expect([canDebug(), canForce()]).toEqual([false, false]);
  useSessionStore.setState({ executor: 'paused', introspection });
  expect([canDebug(), canForce()]).toEqual([false, true]);
  useSessionStore.setState({ executor: 'visualization_ready' });
  expect([canDebug(), canForce()]).toEqual([false, false]);
});

it('finds the nodes of a block, and the one near the hold', () => {
  const held = { uid: 4, path: [1, 4] } as unknown as Held;
  expect(nodesOf({ tree }, 'Dock', 'd').map(({ uid }) => uid)).toEqual([3, 5]);
  expect(nodeOf({ tree, held: null }, 'Dock', 'd')?.uid).toBe(3);
  expect(nodeOf({ tree, held: { ...held, uid: 5, path: [1, 4, 5] } }, 'Dock', 'd')?.uid).toBe(5);
  expect(nodeOf({ tree, held }, 'Main', 'gone')).toBeUndefined();
  expect(tree.map((each) => instanceOf(tree, each))).toEqual([[], [], ['s1'], [], ['s2']]);
});

it('sends what names a node of the running tree', async () => {
  const executor = await openSession();
  await stepTo(tree[2]!);
  useSessionStore.setState({ tree });
  await stepTick();
  useSessionStore.setState({ forced: { nodes: [], alone: 3 } });
  await stepTick();
  await force(nodesOf({ tree }, 'Dock', 'd'), { effect: 'result', status: 'FAILURE', once: true });
  await release([3]);
  await release();
  const forced = { effect: 'result', status: 'FAILURE', once: true, after: false };
  expect(debugged(executor).map(({ command, data }) => [command, data])).toEqual([
    ['step_to', { uid: 3, path: '3' }],
    ['step_to', { uid: 1, path: '1' }],
    ['step_to', { uid: 3, path: '3' }],
    ['force', { uid: 3, path: '3', ...forced }],
    ['force', { uid: 5, path: '5', ...forced }],
    ['release', { uid: 3 }],
    ['release', { uid: null }],
  ]);
});
