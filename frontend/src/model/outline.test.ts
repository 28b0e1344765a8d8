import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from './diagram';
import { outlineRows, outlineSlot } from './outline';
import { vocabulary } from './testing';

const diagram: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'f', 'i'] },
    a: { type: 'Turn' },
    f: { type: 'Fallback', children: ['x', 'y'] },
    x: { type: 'Turn' },
    y: { type: 'Turn' },
    i: { type: 'Inverter', children: ['z'], collapsed: true },
    z: { type: 'Turn' },
  },
};
const rows = outlineRows(diagram);
const slot = (id: string, share: number, ...moving: string[]) =>
  outlineSlot(
    { diagram, vocabulary, moving },
    rows.find((row) => row.id === id)!,
    share,
  );

it('has a line for each visible block', () => {
  expect(rows.map(({ id, depth }) => [id, depth])).toEqual([
    ['r', 0],
    ['a', 1],
    ['f', 1],
    ['x', 2],
    ['y', 2],
    ['i', 1],
  ]);
});

describe('a dragged line goes', () => {
  it.each([
    ['before a line', 'a', 0.1, { parent: 'r', index: 0, edge: 'before' }],
    ['after a leaf', 'a', 0.9, { parent: 'r', index: 1, edge: 'after' }],
    ['below a control, at the end', 'f', 0.5, { parent: 'f', index: 2, edge: 'onto' }],
    ['before the first child of an open line', 'f', 0.9, { parent: 'f', index: 0, edge: 'after' }],
    ['after a folded line', 'i', 0.9, { parent: 'r', index: 3, edge: 'after' }],
    ['beside a decorator that is full', 'i', 0.4, { parent: 'r', index: 2, edge: 'before' }],
    ['below the root, for want of a place beside it', 'r', 0.1, { parent: 'r', index: 3, edge: 'onto' }],
  ])('%s', (_name, id, share, expected) => {
    expect(slot(id, share, 'y')).toMatchObject({ ...expected, row: id });
  });

  it('not into itself', () => {
    expect(slot('x', 0.1, 'f')).toBeNull();
    expect(slot('f', 0.5, 'f')).toBeNull();
  });

  it('to a decorator whose only child it is', () => {
    expect(slot('i', 0.5, 'z')).toMatchObject({ parent: 'i', edge: 'onto' });
  });
});
