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
        const layout = layoutTree(grown(chosen), vocabulary, { orientation, ignorePositions: true });
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

  it('moves what hangs below a block that the user placed', () => {
    const before = layoutTree(small(), vocabulary).positions;
    const { diagram } = edit(small(), setPosition('b', [500, 300]));
    const moved = layoutTree(diagram, vocabulary).positions;
    expect(moved['b']).toMatchObject({ x: 500, y: 300 });
    expect(moved['c']!.x - before['c']!.x).toBe(500 - before['b']!.x);
    expect(moved['a']).toEqual(before['a']);
  });

  it('hides what is folded', () => {
    const folded = {
      ...small(),
      nodes: { ...small().nodes, b: { ...small().nodes['b']!, collapsed: true } },
    };
    expect(Object.keys(layoutTree(folded, vocabulary).positions).sort()).toEqual(['a', 'b', 'r']);
  });
});
