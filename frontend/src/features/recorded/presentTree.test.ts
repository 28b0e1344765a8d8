import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { presentOf, sidesOf } from './presentTree';

const tree = (id: string, nodes: Diagram['nodes'], root = 'n1'): Diagram => ({
  ...emptyDiagram(id),
  root,
  nodes,
});
const ran = tree('Old', { n1: { type: 'Sequence', children: ['n2'] }, n2: { type: 'Go' } });
const other = tree('Other', {
  n1: { type: 'Sequence', children: ['n5', 'n6'] },
  n5: { type: 'A' },
  n6: { type: 'B' },
});

it('finds a tree by its id, or under its new name among those that are new', () => {
  expect(presentOf(ran, ['Old'], { Old: other })).toBe(other);
  const renamed = { ...ran, id: 'New' };
  expect(presentOf(ran, ['Old'], { Other: other, New: renamed })).toBe(renamed);
  expect(presentOf(ran, ['Old', 'New'], { Other: other, New: renamed })).toBeNull();
});

it('compares only what a recorded node has if the file of the tree is not there', () => {
  const now = tree('Old', {
    n1: { type: 'Sequence', children: ['n2', 'off'], comment: 'why', color: 'red' },
    n2: { type: 'Go', conditions: { _skipIf: 'x' } },
    off: { type: 'Wait', disabled: true },
  });
  const withDraft = { ...now, nodes: { ...now.nodes, d: { type: 'Draft' } }, drafts: ['d'] };
  const [before, after] = sidesOf({ diagram: ran, isAttached: false }, withDraft);
  expect(after).toEqual(before);
  expect(sidesOf({ diagram: ran, isAttached: true }, now)[1]).toBe(now);
  expect(sidesOf({ diagram: ran, isAttached: true }, null)[1].root).toBeNull();
});
