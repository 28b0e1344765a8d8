import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '../diagram';
import { operationsBetween } from './between';

const tree = (children: string[], more: object = {}): Diagram => ({
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children },
    ...Object.fromEntries(children.map((id) => [id, { type: 'AlwaysSuccess' }])),
    ...more,
  },
});

it('moves as few siblings as it can', () => {
  expect(operationsBetween(tree(['a', 'b', 'c', 'd']), tree(['d', 'a', 'b', 'c']))).toEqual([
    { op: 'place', id: 'd', at: { parent: 'r' }, after: null },
  ]);
  expect(operationsBetween(tree(['a', 'b', 'c']), tree(['a', 'b', 'c']))).toEqual([]);
});

it('creates a node, places it, and removes what is gone', () => {
  expect(operationsBetween(tree(['a', 'b']), tree(['a', 'n']))).toEqual([
    { op: 'create', id: 'n', node: { type: 'AlwaysSuccess' } },
    { op: 'place', id: 'n', at: { parent: 'r' }, after: 'a' },
    { op: 'remove', id: 'b' },
  ]);
});

it('sets fields of nodes and of the tree one by one', () => {
  const before = tree(['a'], { a: { type: 'Sleep', name: 'x', ports: { msec: '1', other: '2' } } });
  const after = {
    ...tree(['a'], { a: { type: 'Sleep', ports: { msec: '5', other: '2' } } }),
    layout: 'horizontal' as const,
  };
  expect(operationsBetween(before, after)).toEqual([
    { op: 'set', id: '', field: ['layout'], value: 'horizontal' },
    { op: 'set', id: 'a', field: ['name'], value: null },
    { op: 'set', id: 'a', field: ['ports', 'msec'], value: '5' },
  ]);
});

it('takes a child out before its parent is placed below it', () => {
  const before = tree(['a']);
  const after: Diagram = {
    ...before,
    root: null,
    nodes: { r: { type: 'Sequence', children: [] }, a: { type: 'Sequence', children: ['r'] } },
    drafts: ['a'],
  };
  expect(operationsBetween(before, after).filter(({ op }) => op === 'place')).toEqual([
    { op: 'place', id: 'a', at: 'draft', after: null },
    { op: 'place', id: 'r', at: { parent: 'a' }, after: null },
  ]);
});
