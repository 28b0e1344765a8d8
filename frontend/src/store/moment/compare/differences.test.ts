import { expect, it } from 'vitest';
import type { RecordedNode } from '@/store/recording/types';
import { differences, differingBlocks, type Side } from './differences';

const node = (uid: number, parent: number, id: string, tree = 'Main'): RecordedNode => ({
  ...{ uid, parent, node_id: id, tree_id: tree, type: id, name: id, kind: 'action', path: `${id}::${uid}` },
  ports: {},
});
const side = (nodes: RecordedNode[], more: Partial<Side> = {}): Side => ({
  nodes,
  statuses: [],
  flashes: [],
  ...more,
});

it('compares by ids, since numbers differ between two trees', () => {
  const here = side([node(1, 0, 'root'), node(2, 1, 'drive')], { statuses: [[2, 'RUNNING']] });
  const there = side([node(1, 0, 'root'), node(2, 1, 'new'), node(3, 1, 'drive')], {
    statuses: [[3, 'RUNNING']],
  });
  expect(differences(here, there)).toEqual([
    { id: ' Main/new', tree: 'Main', node: 'new', path: 'new::2', here: null, there: 'IDLE' },
  ]);
  expect([...differingBlocks(here, there)]).toEqual([]);
  expect([...differingBlocks(there, here)]).toEqual([['Main/new', null]]);
});

it('takes a result that did not stay rather than the IDLE after it', () => {
  const nodes = [node(1, 0, 'root'), node(2, 1, 'near')];
  const here = side(nodes, { statuses: [[1, 'RUNNING']], flashes: [[2, 'SUCCESS']] });
  const there = side(nodes, { statuses: [[1, 'RUNNING']], flashes: [[2, 'FAILURE']] });
  expect(differences(here, there)).toMatchObject([{ node: 'near', here: 'SUCCESS', there: 'FAILURE' }]);
  expect([...differingBlocks(here, there)]).toEqual([['Main/near', 'FAILURE']]);
});

it('keeps the calls of a tree apart, and shows a block as the canvas does', () => {
  const nodes = [
    node(1, 0, 'root'),
    node(2, 1, 'call1'),
    node(3, 2, 'act', 'Leg'),
    node(4, 1, 'call2'),
    node(5, 4, 'act', 'Leg'),
  ];
  const here = side(nodes, { statuses: [[3, 'RUNNING']] });
  const there = side(nodes, { statuses: [[5, 'RUNNING']] });
  expect(differences(here, there).map(({ path, here: a, there: b }) => [path, a, b])).toEqual([
    ['act::3', 'RUNNING', 'IDLE'],
    ['act::5', 'IDLE', 'RUNNING'],
  ]);
  expect([...differingBlocks(here, there)]).toEqual([]);
});
