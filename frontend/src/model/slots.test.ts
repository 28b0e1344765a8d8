import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from './diagram';
import { layoutTree, type Box } from './layout';
import { isSamePlace, slotFinder } from './slots';
import { vocabulary } from './testing';

const diagram = (layout: Diagram['layout']): Diagram => ({
  ...emptyDiagram('MainTree'),
  root: 'r',
  layout,
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b', 'i'] },
    a: { type: 'Turn' },
    b: { type: 'Fallback' },
    i: { type: 'Inverter', children: ['c'] },
    c: { type: 'Turn' },
  },
});

const centre = (box: Box): [number, number] => [box.x + box.width / 2, box.y + box.height / 2];

describe.each(['vertical', 'horizontal'] as const)('slots in a %s layout', (orientation) => {
  const tree = diagram(orientation);
  const layout = layoutTree(tree, vocabulary);
  const at = (id: string) => layout.positions[id]!;
  const find = (x: number, y: number, ...moving: string[]) =>
    slotFinder({ diagram: tree, layout, vocabulary, moving })(x, y);

  it('exist between two siblings', () => {
    const [ax, ay] = centre(at('a'));
    const [bx, by] = centre(at('b'));
    const slot =
      orientation === 'vertical'
        ? find((at('a').x + at('a').width + at('b').x) / 2, Math.min(ay, by))
        : find(Math.min(ax, bx), (at('a').y + at('a').height + at('b').y) / 2);
    expect(slot).toMatchObject({ parent: 'r', index: 1, kind: 'between' });
  });

  it('exist on a block that accepts children', () => {
    expect(find(...centre(at('b')))).toMatchObject({ parent: 'b', index: 0, kind: 'onto' });
  });

  it('exist beside a decorator that is full', () => {
    expect(find(...centre(at('i')))).toMatchObject({ parent: 'r', kind: 'between' });
  });

  it('do not exist far from the tree', () => {
    expect(find(9000, 9000)).toBeNull();
  });

  it('are never below the moved block', () => {
    const slot = find(...centre(at('c')), 'i');
    expect(slot?.parent).not.toBe('i');
    expect(slot?.parent).not.toBe('c');
  });

  it('are never below any of several moved blocks, nor where only one of them has room', () => {
    expect(find(...centre(at('b')), 'a', 'b')?.parent).not.toBe('b');
    const freed = { ...tree, nodes: { ...tree.nodes, i: { type: 'Inverter' } }, drafts: ['c'] };
    const drawn = layoutTree(freed, vocabulary);
    const onto = (...moving: string[]) =>
      slotFinder({ diagram: freed, layout: drawn, vocabulary, moving })(...centre(drawn.positions['i']!));
    expect(onto('a')).toMatchObject({ parent: 'i', kind: 'onto' });
    expect(onto('a', 'c')).toMatchObject({ parent: 'r', kind: 'between' });
  });
});

it('recognise the place that a block already has', () => {
  const slot = { parent: 'r', kind: 'between', mark: { x: 0, y: 0, width: 0, height: 0 } } as const;
  const tree = diagram('vertical');
  expect([0, 1, 2, 3].map((index) => isSamePlace(tree, ['b'], { ...slot, index }))).toEqual([
    false,
    true,
    true,
    false,
  ]);
  expect([0, 1, 2, 3].map((index) => isSamePlace(tree, ['a', 'b'], { ...slot, index }))).toEqual([
    true,
    true,
    true,
    false,
  ]);
  expect(isSamePlace(tree, ['a', 'i'], { ...slot, index: 1 })).toBe(false);
});

describe.each(['vertical', 'horizontal'] as const)('slots between stacked leaves (%s)', (orientation) => {
  const tree: Diagram = {
    ...diagram(orientation),
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b', 'c', 'i'] },
      a: { type: 'Turn' },
      b: { type: 'Turn', name: 'a much longer name' },
      c: { type: 'Turn' },
      i: { type: 'Inverter', children: ['d'] },
      d: { type: 'Turn' },
    },
  };
  const layout = layoutTree(tree, vocabulary, { isCompact: true });
  const at = (id: string) => layout.positions[id]!;
  const find = (x: number, y: number) => slotFinder({ diagram: tree, layout, vocabulary })(x, y);
  const isVertical = orientation === 'vertical';

  it('are a bar across the column', () => {
    const [x, y] = centre(at('a'));
    const slot = isVertical
      ? find(x, (at('a').y + at('a').height + at('b').y) / 2)
      : find((at('a').x + at('a').width + at('b').x) / 2, y);
    expect(slot).toMatchObject({ parent: 'r', index: 1, kind: 'between' });
    expect(isVertical ? slot!.mark.height : slot!.mark.width).toBe(4);
  });

  it('are above the first and below the last', () => {
    const [x, y] = centre(at('a'));
    const first = isVertical ? find(x, at('a').y + 2) : find(at('a').x + 2, y);
    expect(first).toMatchObject({ parent: 'r', index: 0 });
    const [lx, ly] = centre(at('c'));
    const last = isVertical
      ? find(lx, at('c').y + at('c').height - 2)
      : find(at('c').x + at('c').width - 2, ly);
    expect(last).toMatchObject({ parent: 'r', index: 3 });
    expect(isVertical ? last!.mark.height : last!.mark.width).toBe(4);
  });

  it('are beside the column for blocks beside it', () => {
    const i = at('i');
    const slot = isVertical
      ? find(i.x + i.width - 2, i.y + i.height / 2)
      : find(i.x + i.width / 2, i.y + i.height - 2);
    expect(slot).toMatchObject({ parent: 'r', index: 4 });
  });
});
