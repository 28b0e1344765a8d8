import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { done, edited, plain, RUNS, start } from '../../../harness/edited';
import { topsOf } from '../diagram';
import { setName } from '../edits';
import { legalStep, steps } from '../testing';
import { emptyUndo } from '../undo';
import { applied } from './apply';
import { operationsBetween } from './between';

describe('operations', () => {
  it('make the later tree of the earlier one', () => {
    fc.assert(
      fc.property(steps, steps, (first, second) => {
        const before = edited(start, first).diagram;
        const after = edited(before, second).diagram;
        const { diagram, refused } = applied(before, operationsBetween(before, after));
        expect(refused).toEqual([]);
        expect(plain(diagram)).toEqual(plain(after));
        const back = applied(after, operationsBetween(after, before));
        expect(plain(back.diagram)).toEqual(plain(before));
      }),
      { numRuns: RUNS },
    );
  });

  it('leave a forest, and lose no node of others, on a tree that others changed', () => {
    fc.assert(
      fc.property(steps, steps, steps, (first, mine, theirs) => {
        const base = edited(start, first).diagram;
        const now = edited(base, theirs).diagram;
        const changes = operationsBetween(base, edited(base, mine).diagram);
        const { diagram } = applied(now, changes);
        const removed = new Set(changes.flatMap((each) => (each.op === 'remove' ? [each.id] : [])));
        const reached = new Set<string>();
        const open = [...topsOf(diagram)];
        for (let id = open.pop(); id !== undefined; id = open.pop()) {
          expect(reached.has(id)).toBe(false);
          reached.add(id);
          open.push(...(diagram.nodes[id]?.children ?? []));
        }
        expect(reached).toEqual(new Set(Object.keys(diagram.nodes)));
        for (const id of Object.keys(now.nodes)) expect(reached.has(id) || removed.has(id)).toBe(true);
      }),
      { numRuns: RUNS },
    );
  });

  it('are refused where they do not apply, and change nothing then', () => {
    const { diagram } = done(start, emptyUndo, legalStep(start, 0, 0, 3) ?? setName('root', 'x'));
    const [child = ''] = diagram.nodes['root']?.children ?? [];
    const changes = [
      { op: 'set', id: 'gone', field: ['name'], value: 'x' },
      { op: 'create', id: 'root', node: { type: 'Sequence' } },
      { op: 'place', id: 'root', at: { parent: child }, after: null },
      { op: 'place', id: child, at: { parent: 'gone' }, after: null },
      { op: 'remove', id: 'gone' },
      { op: 'remove', id: '' },
    ] as const;
    const result = applied(diagram, changes);
    expect(result.refused).toEqual(changes);
    expect(result.diagram).toEqual(diagram);
  });
});
