import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from './diagram';
import { edit, setPosition } from './edits';
import { layoutTree, type Box } from './layout';
import { legalStep, steps, vocabulary } from './testing';

const RUNS = Number(process.env.BT_STUDIO_FULL ? 10_000 : 400);

const overlap = (a: Box, b: Box): boolean =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

function grown(chosen: readonly (readonly [number, number, number])[]): Diagram {
  return chosen.reduce((diagram, [what, where, which]) => {
    const recipe = legalStep(diagram, what, where, which);
    return recipe ? edit(diagram, recipe).diagram : diagram;
  }, emptyDiagram('MainTree'));
}

describe('layoutTree', () => {
  it.each(['vertical', 'horizontal'] as const)('never lets blocks overlap (%s)', (orientation) => {
    fc.assert(
      fc.property(steps, (chosen) => {
        const layout = layoutTree(grown(chosen), vocabulary, {
          orientation,
          ignorePositions: true,
          isCompact: chosen.length % 2 === 0,
        });
        const boxes = Object.values(layout.positions);
        boxes.forEach((box, index) => {
          for (const other of boxes.slice(index + 1)) expect(overlap(box, other)).toBe(false);
        });
      }),
      { numRuns: RUNS },
    );
  });

  const small = (): Diagram => ({
    ...emptyDiagram('MainTree'),
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b'] },
      a: { type: 'Turn' },
      b: { type: 'Inverter', children: ['c'] },
      c: { type: 'Turn' },
    },
  });

  it('keeps the order of children, parents above, and the root at the origin', () => {
    const { positions } = layoutTree(small(), vocabulary);
    expect(positions['r']).toMatchObject({ x: 0, y: 0 });
    expect(positions['a']!.x).toBeLessThan(positions['b']!.x);
    expect(positions['a']!.y).toBeGreaterThan(positions['r']!.height);
  });

  it.each(['vertical', 'horizontal'] as const)(
    'stacks neighbouring leaves if it is compact (%s)',
    (layout) => {
      const leaves = Array.from({ length: 14 }, (_, at) => `l${at}`);
      const wide: Diagram = {
        ...emptyDiagram('MainTree'),
        layout,
        root: 'r',
        nodes: {
          r: { type: 'Sequence', children: ['a', 'i', ...leaves] },
          a: { type: 'Turn' },
          i: { type: 'Inverter', children: ['c'] },
          c: { type: 'Turn' },
          ...Object.fromEntries(leaves.map((id) => [id, { type: 'Turn' }])),
        },
      };
      const { positions, stacked, width, height } = layoutTree(wide, vocabulary, { isCompact: true });
      const plain = layoutTree(wide, vocabulary);
      const [along, across] = layout === 'vertical' ? (['x', 'y'] as const) : (['y', 'x'] as const);
      // Two columns of seven; a lone leaf stays beside its siblings.
      expect(stacked).toEqual(new Set(leaves));
      expect(positions['l1']![along]).toBe(positions['l0']![along]);
      expect(positions['l1']![across]).toBeGreaterThan(positions['l0']![across]);
      expect(positions['l7']![along]).toBeGreaterThan(positions['l6']![along]);
      expect(positions['l7']![across]).toBe(positions['l0']![across]);
      expect(plain.stacked).toBeUndefined();
      if (layout === 'vertical') expect(width).toBeLessThan(plain.width / 3);
      else expect(height).toBeLessThan(plain.height / 3);
    },
  );

  it('does not stack leaves with a manual position', () => {
    const three = (): Diagram => ({
      ...emptyDiagram('MainTree'),
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 'b', 'c'] },
        a: { type: 'Turn' },
        b: { type: 'Turn', position: [900, 90] },
        c: { type: 'Turn' },
      },
    });
    expect(layoutTree(three(), vocabulary, { isCompact: true }).stacked).toEqual(new Set());
    const ignored = layoutTree(three(), vocabulary, { isCompact: true, ignorePositions: true });
    expect(ignored.stacked).toEqual(new Set(['a', 'b', 'c']));
  });

  it('moves the subtree of a block with a manual position', () => {
    const before = layoutTree(small(), vocabulary).positions;
    const { diagram } = edit(small(), setPosition('b', [500, 300]));
    const moved = layoutTree(diagram, vocabulary).positions;
    expect(moved['b']).toMatchObject({ x: 500, y: 300 });
    expect(moved['c']!.x - before['c']!.x).toBe(500 - before['b']!.x);
    expect(moved['a']).toEqual(before['a']);
  });

  it('leaves out folded blocks', () => {
    const folded = {
      ...small(),
      nodes: { ...small().nodes, b: { ...small().nodes['b']!, collapsed: true } },
    };
    expect(Object.keys(layoutTree(folded, vocabulary).positions).sort()).toEqual(['a', 'b', 'r']);
  });
});
