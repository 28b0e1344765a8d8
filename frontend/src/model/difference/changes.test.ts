import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { treeDifference } from './changes';
import { emptyDiagram, preorder, type Diagram, type DiagramNode } from '../diagram';
import { edit } from '../edits';
import { legalStep, steps } from '../testing';

function tree(nodes: Record<string, DiagramNode>, root: string | null = 'n1'): Diagram {
  return { format: 'bt-studio/diagram', version: 1, id: 'Main', root, nodes, drafts: [], layout: 'vertical' };
}

const older = tree({
  n1: { type: 'Sequence', children: ['n2', 'n3', 'n4'] },
  n2: { type: 'A', ports: { speed: '1', gone: 'x' } },
  n3: { type: 'Inverter', children: ['n5'] },
  n4: { type: 'B' },
  n5: { type: 'C' },
});

const grown = (from: Diagram, path: readonly (readonly [number, number, number])[]): Diagram =>
  path.reduce((diagram, step) => {
    const recipe = legalStep(diagram, ...step);
    return recipe ? edit(diagram, recipe).diagram : diagram;
  }, from);

describe('treeDifference', () => {
  it('reports changed, added, moved and removed nodes, and keeps removed ones in place', () => {
    const newer = tree({
      n1: { type: 'Sequence', children: ['n6', 'n2', 'n4'] },
      n2: { type: 'A', ports: { speed: '2' }, comment: 'fast' },
      n4: { type: 'B' },
      n6: { type: 'Repeat', children: ['n5'] },
      n5: { type: 'C' },
    });
    const { merged, changes } = treeDifference(older, newer);
    expect([...changes].map(([id, { kind }]) => [id, kind])).toEqual([
      ['n6', 'added'],
      ['n5', 'moved'],
      ['n2', 'changed'],
      ['n3', 'removed'],
    ]);
    expect(changes.get('n2')?.fields).toEqual([
      { field: 'gone', before: 'x', after: null },
      { field: 'speed', before: '1', after: '2' },
      { field: 'comment', before: null, after: 'fast' },
    ]);
    expect(merged.nodes['n1']?.children).toEqual(['n6', 'n2', 'n3', 'n4']);
  });

  it('reports a new order of siblings, but no new position', () => {
    const swapped = tree({ ...older.nodes, n1: { type: 'Sequence', children: ['n3', 'n2', 'n4'] } });
    const { changes } = treeDifference(older, swapped);
    expect([...changes]).toEqual([['n3', { kind: 'moved', fields: [], deed: 'reordered' }]]);
    const placed = tree({ ...older.nodes, n4: { type: 'B', position: [3, 4] } });
    expect(treeDifference(older, placed).changes.size).toBe(0);
  });

  it('draws each block of both trees once', () => {
    fc.assert(
      fc.property(steps, steps, (first, then) => {
        const one = grown(emptyDiagram('Main'), first);
        const other = grown(one, then);
        const { merged, changes } = treeDifference(one, other);
        const removed = [...changes].filter(([, { kind }]) => kind === 'removed').map(([id]) => id);
        const drawn = preorder(merged);
        expect(new Set(drawn)).toEqual(new Set([...removed, ...Object.keys(other.nodes)]));
        expect(drawn).toHaveLength(new Set(drawn).size);
        for (const id of removed) expect(id in one.nodes && !(id in other.nodes)).toBe(true);
      }),
      { numRuns: 100 },
    );
  });
});
