import { expect, it } from 'vitest';
import type { ServerMessage, TreeNode } from '@/generated/messages';
import { BIT } from './nodeTrace';
import { trace } from './trace';
import { feedTrace } from './traceFeed';

const node: TreeNode = {
  ...{ uid: 1, parent: 0, type: 'Forward', kind: 'Action', name: 'Go', path: 'Go' },
  ...{ node_id: 'n1', tree_id: 'Main' },
};
const feed = (command: string, data: unknown, t: number) =>
  feedTrace({ command, data, t, seq: 0 } as unknown as ServerMessage);
const begun = (t: number) => {
  feed('progress', { rung: 'run_application', fraction: 0, message: '' }, t);
  feed('tree', { nodes: [node] }, t);
  feed('state-changed', { state: 'application_running' }, t);
  feed('tick', { n: 1, changed: [[1, 'RUNNING']], flashed: [] }, t);
};

it('begins with each run, and continues where a running tree is replaced', () => {
  begun(1);
  feed('sim', {}, 3);
  feed('tree', { nodes: [node] }, 3);
  feed('tick', { n: 2, changed: [[1, 'RUNNING']], flashed: [] }, 4);
  feed('sim', {}, 5);
  expect(trace.stretches(1, 0, 9)).toEqual([
    { start: 1, end: 3, mask: BIT.RUNNING },
    { start: 4, end: 5, mask: BIT.RUNNING },
  ]);
  begun(6);
  expect(trace.begin).toBe(6);
  expect(trace.stretches(1, 0, 9)).toEqual([{ start: 6, end: 6, mask: BIT.RUNNING }]);
});

it('continues where a tree is replaced after the page was loaded in the middle of a run', () => {
  const data = { state: 'paused', tree: { nodes: [node] }, statuses: [[1, 'RUNNING']] };
  feed('snapshot', data, 2);
  feed('tree', { nodes: [node] }, 4);
  expect(trace.stretches(1, 0, 9)).toEqual([{ start: 2, end: 4, mask: BIT.RUNNING }]);
});
