import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from '../diagram';
import { match } from './match';
import { shapeOf } from './shape';

const tree = (root: string, nodes: Record<string, DiagramNode>): Diagram => ({
  ...emptyDiagram('Main'),
  root,
  nodes,
});
const pairs = (older: Diagram, newer: Diagram) => Object.fromEntries(match(shapeOf(older), shapeOf(newer)));

const older = tree('r', {
  r: { type: 'Sequence', children: ['a', 'b'] },
  a: { type: 'Inverter', children: ['c'] },
  b: { type: 'Turn', ports: { speed: '1' } },
  c: { type: 'IsNear' },
});

it('pairs nodes of one id whatever they say', () => {
  const newer = tree('r', { r: { type: 'Fallback', children: ['b'] }, b: { type: 'Forward' } });
  expect(pairs(older, newer)).toEqual({ r: 'r', b: 'b' });
});

it('pairs equal branches, then their parents, then what is left below them', () => {
  const newer = tree('x', {
    x: { type: 'Sequence', children: ['z', 'y'] },
    y: { type: 'Inverter', children: ['w'] },
    z: { type: 'Turn', ports: { speed: '2' } },
    w: { type: 'IsNear' },
  });
  expect(pairs(older, newer)).toEqual({ r: 'x', a: 'y', c: 'w', b: 'z' });
});

it('pairs nothing of an empty tree', () => {
  expect(pairs(older, emptyDiagram('Main'))).toEqual({});
});
