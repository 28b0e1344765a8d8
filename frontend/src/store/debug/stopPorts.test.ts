import { expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { blackboardId } from '@/store/session/reduce';
import { openProject } from '../../../harness/testing';
import { portsOf } from './stopPorts';

const node = (uid: number, parent: number, type: string, tree: string, id: string, path: string) =>
  ({ uid, parent, type, kind: '', name: '', path, tree_id: tree, node_id: id }) satisfies TreeNode;
const tree = [
  node(1, 0, 'Sequence', 'Main', 'r', 'Sequence'),
  node(2, 1, 'Move', 'Main', 'a', 'Move'),
  node(3, 1, 'SubTree', 'Main', 's', 'Dock::3'),
  node(4, 3, 'Move', 'Dock', 'd', 'Dock::3/Move'),
];
const row = (key: string, value: unknown) => {
  const entry = { scope: '', key, value, type: 'float', preview: false, removed: false, changedAt: 1 };
  return { [blackboardId(entry)]: entry };
};

it('are the texts of the block, with the values of keys in its own scope or those around', () => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 's'] },
        a: { type: 'Move', ports: { speed: '{v}', text: 'fast', goal: '{missing}' } },
        s: { type: 'SubTree', tree: 'Dock', ports: { rate: '{v}' } },
      },
      Dock: { d: { type: 'Move', ports: { speed: '{rate}' } } },
    },
  });
  const session = { tree, blackboard: row('v', 0.5) };
  expect(portsOf(tree[1]!, session)).toEqual([
    { name: 'speed', text: '{v}', key: 'v', isSet: true, value: 0.5 },
    { name: 'text', text: 'fast', key: null, isSet: false, value: 'fast' },
    { name: 'goal', text: '{missing}', key: 'missing', isSet: false, value: '{missing}' },
  ]);
  expect(portsOf(tree[3]!, session)).toMatchObject([{ key: 'rate', isSet: true, value: 0.5 }]);
  expect(portsOf({ ...tree[1]!, node_id: 'gone' }, session)).toEqual([]);
});
