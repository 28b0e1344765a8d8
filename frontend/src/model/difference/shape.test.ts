import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '../diagram';
import { below, branchOf, fieldsOf, indexIn, parentIn, ROOT, shapeOf, textOf, treeFieldsOf } from './shape';

const diagram: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b'] },
    a: { type: 'Inverter', children: ['c'] },
    b: { type: 'Turn', name: '', ports: { speed: '1', angle: '2' }, comment: '', position: [1, 2] },
    c: { type: 'IsNear' },
    d: { type: 'IsNear' },
  },
  drafts: ['d'],
};
const shape = shapeOf(diagram);

it('links in both directions, the root and the drafts, too', () => {
  expect(shape.order).toEqual(['r', 'a', 'c', 'b', 'd']);
  expect(branchOf(shape, 'a')).toEqual(['a', 'c']);
  expect([below(shape, ROOT), below(shape, null), below(shape, 'r')]).toEqual([['r'], ['d'], ['a', 'b']]);
  expect(['r', 'b', 'd'].map((id) => [parentIn(shape, id), indexIn(shape, id)])).toEqual([
    [ROOT, 0],
    ['r', 1],
    [null, 0],
  ]);
});

it('tells what a node says without its defaults; an empty name is one', () => {
  expect([...fieldsOf(diagram.nodes['b'] ?? { type: '' })]).toEqual([
    ['type', 'Turn'],
    ['name', ''],
    ['ports.angle', '2'],
    ['ports.speed', '1'],
  ]);
  expect(fieldsOf(diagram.nodes['b'] ?? { type: '' }, true).get('position')).toBe('[1,2]');
});

it('tells what a tree says', () => {
  const ports = [{ name: 'speed', type: 'double', direction: 'input' }];
  expect([...treeFieldsOf({ ...diagram, ports, layout: 'horizontal' }, true)]).toEqual([
    ['id', 'Main'],
    ['ports.speed', '{"direction":"input","type":"double"}'],
    ['layout', 'horizontal'],
  ]);
  expect(textOf({ b: [1], a: true })).toBe('{"a":true,"b":[1]}');
});
