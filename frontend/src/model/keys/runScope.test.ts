import { expect, it } from 'vitest';
import { emptyDiagram } from '../diagram';
import { treeOfScope } from './runScope';

const diagrams = {
  Main: {
    ...emptyDiagram('Main'),
    nodes: { a: { type: 'SubTree', tree: 'Dock', name: 'home' }, b: { type: 'SubTree', tree: 'Go' } },
  },
  Dock: { ...emptyDiagram('Dock'), nodes: { c: { type: 'SubTree', tree: 'Go' } } },
  Go: emptyDiagram('Go'),
};

it.each([
  ['', 'Main'],
  ['home', 'Dock'],
  ['Go::4', 'Go'],
  ['home/Go::7', 'Go'],
  ['gone', null],
])('the scope %j is that of %s', (scope, tree) => {
  expect(treeOfScope({ diagrams, mainTree: 'Main' }, scope)).toBe(tree);
});
