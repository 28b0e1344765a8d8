import { describe, expect, it } from 'vitest';
import type { Diagram, DiagramNode, NodeId } from './diagram';
import { addNode, edit, insertFragment } from './edits';
import { bestPlacement, type Placement } from './rules';
import { vocabulary } from './testing';

const tree = (nodes: Record<NodeId, DiagramNode>, drafts: NodeId[] = []): Diagram => ({
  format: 'bt-studio/diagram',
  version: 1,
  id: 'Main',
  root: 'r',
  layout: 'vertical',
  drafts,
  nodes,
});
const LEAF = tree({ r: { type: 'Sleep' } });
const NEW = { type: 'AlwaysSuccess' };
const added = (diagram: Diagram, place: Placement) => edit(diagram, addNode('new', NEW, place)).diagram;

/** The types of a tree, as nested lists. */
function shape({ nodes }: Diagram, id: NodeId): unknown[] {
  const { type, children = [] } = nodes[id] as DiagramNode;
  return [type, ...children.map((child) => shape({ nodes } as Diagram, child))];
}
const wholeShape = (diagram: Diagram) => shape(diagram, diagram.root ?? '');

describe('the best place of a new block', () => {
  it('is the root of an empty tree', () => {
    expect(bestPlacement({ ...LEAF, root: null, nodes: {} }, undefined, vocabulary)).toEqual({ at: 'root' });
  });

  it('is under the nearest block with room, after the branch of the selected one', () => {
    const diagram = tree({
      r: { type: 'Sequence', children: ['i', 'a'] },
      i: { type: 'Inverter', children: ['x'] },
      x: NEW,
      a: NEW,
    });
    expect(bestPlacement(diagram, 'x', vocabulary)).toEqual({ at: 'child', parent: 'r', index: 1 });
  });

  it.each([undefined, 'r'])('beside a leaf that is the root is in a Sequence with it (%s)', (selected) => {
    const place = bestPlacement(LEAF, selected, vocabulary);
    expect(place).toEqual({ at: 'beside', node: 'r' });
    const diagram = added(LEAF, place);
    expect(wholeShape(diagram)).toEqual(['Sequence', ['Sleep'], ['AlwaysSuccess']]);
    expect(diagram.drafts).toEqual([]);
  });

  it('beside the child of a decorator is under that, in a Sequence', () => {
    const diagram = tree({ r: { type: 'Inverter', children: ['x'] }, x: { type: 'Sleep' } });
    const place = bestPlacement(diagram, 'x', vocabulary);
    expect(wholeShape(added(diagram, place))).toEqual([
      'Inverter',
      ['Sequence', ['Sleep'], ['AlwaysSuccess']],
    ]);
  });

  it('keeps the place of a draft', () => {
    const diagram = tree({ r: { type: 'Sleep' }, d: { type: 'Sleep', position: [40, 50] } }, ['d']);
    const { nodes, drafts } = added(diagram, bestPlacement(diagram, 'd', vocabulary));
    expect(drafts).toHaveLength(1);
    expect(nodes[drafts[0] ?? '']).toMatchObject({
      type: 'Sequence',
      position: [40, 50],
      children: ['d', 'new'],
    });
    expect(nodes['d']?.position).toBeUndefined();
  });

  it('takes several blocks, in their order', () => {
    const fragment = { tops: ['p', 'q'], nodes: { p: NEW, q: { type: 'AlwaysFailure' } } };
    const { diagram } = edit(LEAF, insertFragment(fragment, { at: 'beside', node: 'r' }));
    expect(wholeShape(diagram)).toEqual(['Sequence', ['Sleep'], ['AlwaysSuccess'], ['AlwaysFailure']]);
  });
});
