import { expect, it } from 'vitest';
import { preorder } from '@/model/diagram';
import type { RecordedNode } from '@/store/recording/types';
import { attachedName, FOREIGN_TREE, identified, recordedTrees } from './recordedTrees';

const node = (uid: number, parent: number, type: string, more: Partial<RecordedNode> = {}): RecordedNode => ({
  uid,
  parent,
  type,
  kind: 'action',
  name: type,
  path: type,
  node_id: `n${uid}`,
  tree_id: 'Main',
  ports: {},
  ...more,
});
/** A tree that calls `Leg` twice. */
const ran = [
  node(1, 0, 'Sequence', { name: 'walk::1' }),
  node(2, 1, 'SubTree', { name: 'Leg', node_id: 'left' }),
  node(3, 2, 'Step', { tree_id: 'Leg', node_id: 'a', ports: { length: '0.3' } }),
  node(4, 1, 'SubTree', { name: 'right leg', node_id: 'right' }),
  node(5, 4, 'Step', { tree_id: 'Leg', node_id: 'a', ports: { length: '0.3' } }),
];
const file = (nodes: object, root = 'n1') =>
  JSON.stringify({ format: 'bt-studio/diagram', version: 1, id: 'Main', root, nodes, drafts: [] });

it('makes diagrams of the recorded nodes', () => {
  const trees = recordedTrees(ran, {});
  expect(Object.keys(trees)).toEqual(['Main', 'Leg']);
  expect(trees['Main']?.isAttached).toBe(false);
  expect(trees['Main']?.diagram.nodes).toEqual({
    n1: { type: 'Sequence', name: 'walk', children: ['left', 'right'] },
    left: { type: 'SubTree', tree: 'Leg' },
    right: { type: 'SubTree', tree: 'Leg', name: 'right leg' },
  });
  expect(trees['Leg']?.diagram).toMatchObject({
    root: 'a',
    drafts: [],
    nodes: { a: { type: 'Step', ports: { length: '0.3' } } },
  });
});

it('shows an attached diagram, with nothing folded, also its parts that did not run', () => {
  const nodes = {
    n1: { type: 'Sequence', children: ['left', 'right', 'off'], collapsed: true, comment: 'why' },
    left: { type: 'SubTree', tree: 'Leg' },
    right: { type: 'SubTree', tree: 'Leg' },
    off: { type: 'Wait', disabled: true },
  };
  const { diagram: main, isAttached } = recordedTrees(ran, { [attachedName('Main')]: file(nodes) })['Main']!;
  expect(isAttached).toBe(true);
  expect(main.nodes['n1']).toMatchObject({ comment: 'why', collapsed: false });
  expect(preorder(main)).toEqual(['n1', 'left', 'right', 'off']);
});

it('has the port texts that ran, where they are others than those of the file', () => {
  const leg = JSON.stringify({
    format: 'bt-studio/diagram',
    version: 1,
    id: 'Leg',
    root: 'a',
    nodes: { a: { type: 'Step', ports: { length: '0.1', side: 'left' } } },
    drafts: [],
  });
  const { diagram, isAttached } = recordedTrees(ran, { [attachedName('Leg')]: leg })['Leg']!;
  expect(isAttached).toBe(true);
  expect(diagram.nodes['a']?.ports).toEqual({ length: '0.3', side: 'left' });
});

it.each([
  ['is no JSON', '{'],
  ['lacks a node that ran', file({ n1: { type: 'Sequence' } })],
  ['has a node of another type', file({ n1: { type: 'Fallback' }, left: {}, right: {} })],
])('does not show an attached file that %s', (_, text) => {
  const main = recordedTrees(ran, { [attachedName('Main')]: text })['Main'];
  expect(main).toEqual(recordedTrees(ran, {})['Main']);
});

it('gives nodes of a foreign log ids, and makes one tree of them', () => {
  const foreign = ran.map((each) => ({ ...each, node_id: '', tree_id: '' }));
  const nodes = identified(foreign);
  const [id, { diagram }] = Object.entries(recordedTrees(nodes, {}))[0]!;
  expect(id).toBe(FOREIGN_TREE);
  expect(preorder(diagram)).toEqual(['n1', 'n2', 'n3', 'n4', 'n5']);
  expect(identified(ran)).toBe(ran);
});

it('ends with nodes that name each other as parents', () => {
  const trees = recordedTrees([node(1, 2, 'A'), node(2, 1, 'B'), node(3, 3, 'C')], {});
  expect(preorder(trees['Main']!.diagram)).toEqual(['n1', 'n2', 'n3']);
});
