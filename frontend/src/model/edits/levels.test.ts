import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '../diagram';
import { edit } from './core';
import { collapseToLevel } from './levels';

const tree: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['f', 'a'] },
    f: { type: 'Fallback', children: ['i'], collapsed: true },
    i: { type: 'Inverter', children: ['b'] },
    a: { type: 'Sleep' },
    b: { type: 'Sleep' },
    d: { type: 'Inverter', children: ['e'] },
    e: { type: 'Sleep' },
  },
  drafts: ['d'],
};
const folded = (level: number) =>
  Object.entries(edit(tree, collapseToLevel(level)).diagram.nodes)
    .filter(([, { collapsed }]) => collapsed)
    .map(([id]) => id);

it.each([
  [1, ['f', 'i']],
  [2, ['i']],
  [3, []],
  [Infinity, []],
])('shows %s levels below the root, and of the drafts', (level, expected) => {
  expect(folded(level)).toEqual(expected);
});

it('changes nothing if the tree is already folded like that', () => {
  const { diagram } = edit(tree, collapseToLevel(2));
  expect(edit(diagram, collapseToLevel(2)).diagram).toBe(diagram);
});
