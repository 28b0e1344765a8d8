import { afterAll, beforeAll, beforeEach, expect, it, vi } from 'vitest';
import type { NodeStatus, ServerMessage } from '@/generated/messages';
import { useLiveStore } from '@/store/project/live';
import { feedLive, showDueStatuses } from './liveFeed';
import { setStatusRate } from './statusRate';

const NODE = { uid: 1, parent: 0, type: 'Go', kind: 'Action', name: 'Go', path: 'Go' };

function hear(command: ServerMessage['command'], data: unknown): void {
  feedLive({ id: 'e1', command, data, seq: 1, t: 0 } as ServerMessage);
  showDueStatuses();
}

const tick = (status: NodeStatus): void =>
  hear('tick', { n: 1, changed: [[1, status]], flashed: [], duration_ms: 1, past: [] });
const shown = (): NodeStatus | undefined => useLiveStore.getState().statuses.get('Main/n1');

beforeAll(() => {
  vi.useFakeTimers();
});

beforeEach(() => {
  setStatusRate(0);
  // This is long after any update of an earlier test.
  vi.advanceTimersByTime(10_000);
  hear('tree', { nodes: [{ ...NODE, tree_id: 'Main', node_id: 'n1' }] });
});

afterAll(() => {
  vi.useRealTimers();
});

it('shows every status where no rate is set', () => {
  for (const status of ['RUNNING', 'SUCCESS', 'FAILURE'] as const) {
    tick(status);
    expect(shown()).toBe(status);
  }
});

it('shows statuses twice a second if the user wants that, and then the latest', () => {
  setStatusRate(2);
  tick('RUNNING');
  expect(shown()).toBe('RUNNING');
  vi.advanceTimersByTime(100);
  tick('SUCCESS');
  tick('FAILURE');
  vi.advanceTimersByTime(390);
  expect(shown()).toBe('RUNNING');
  vi.advanceTimersByTime(20);
  expect(shown()).toBe('FAILURE');
});

it('shows at once how a stopped tree ended, whatever the rate', () => {
  setStatusRate(2);
  tick('RUNNING');
  tick('SUCCESS');
  hear('state-changed', { state: 'paused' });
  expect(shown()).toBe('SUCCESS');
});

it('shows the last tick until another one comes', () => {
  setStatusRate(2);
  hear('tick', { n: 1, changed: [], flashed: [[1, 'FAILURE']], duration_ms: 1, past: [[1, 'FAILURE']] });
  expect(useLiveStore.getState().past.get('Main/n1')).toBe('FAILURE');
  hear('tick', { n: 2, changed: [], flashed: [], duration_ms: 1, past: [] });
  vi.advanceTimersByTime(600);
  expect(useLiveStore.getState().past.size).toBe(0);
});

it('shows the statuses within a tick that is held at a line of Python, until it ends', () => {
  tick('RUNNING');
  hear('held_in_python', { uid: 1, path: [1], tick: 2, statuses: [[1, 'FAILURE']] });
  expect(shown()).toBe('FAILURE');
  hear('tick', { n: 2, changed: [], flashed: [], duration_ms: 1, past: [] });
  expect(shown()).toBe('RUNNING');
});

it('shows the statuses within a held tick, and gives the end of the tick those before it', () => {
  tick('RUNNING');
  hear('held', { statuses: [[1, 'FAILURE']] });
  expect(shown()).toBe('FAILURE');
  hear('held', { statuses: [] });
  expect(shown()).toBe('IDLE');
  // The tick ends without a change of the node: it is as it was before.
  hear('tick', { n: 2, changed: [], flashed: [], duration_ms: 1, past: [] });
  expect(shown()).toBe('RUNNING');
  hear('held', { statuses: [[1, 'SUCCESS']] });
  hear('released', { off: false });
  expect(shown()).toBe('RUNNING');
});

it('shows the statuses of a held tick to who joins then', () => {
  hear('snapshot', {
    tree: { nodes: [{ ...NODE, tree_id: 'Main', node_id: 'n1' }] },
    statuses: [[1, 'RUNNING']],
    past: [],
    faults: [],
    held: { statuses: [[1, 'SUCCESS']] },
  });
  expect(shown()).toBe('SUCCESS');
});
