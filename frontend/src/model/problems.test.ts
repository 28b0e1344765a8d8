import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from './diagram';
import { findProblems } from './problems';
import { vocabulary } from './testing';

function kinds(
  nodes: Record<string, DiagramNode>,
  root: string | null = 'r',
  drafts: string[] = [],
): string[] {
  const diagram: Diagram = { ...emptyDiagram('MainTree'), root, nodes, drafts };
  return findProblems(diagram, vocabulary).map(({ kind, node, port }) =>
    [node, kind, port].filter(Boolean).join(' '),
  );
}
const under = (node: DiagramNode) => ({ r: { type: 'Sequence', children: ['x'] }, x: node });

describe('findProblems', () => {
  it.each<[string, Record<string, DiagramNode>, string[]]>([
    ['a sound tree', under({ type: 'Turn', ports: { ang_speed: '0.5' } }), []],
    ['an empty control node', { r: { type: 'Sequence' } }, ['r too-few-children']],
    [
      'a leaf with children',
      { r: { type: 'Turn', children: ['x'] }, x: { type: 'Turn' } },
      ['r too-many-children'],
    ],
    [
      'a second child of a decorator',
      { r: { type: 'Inverter', children: ['x', 'y'] }, x: { type: 'Turn' }, y: { type: 'Turn' } },
      ['r too-many-children'],
    ],
    ['an unknown type', under({ type: 'Nope' }), ['x unknown-type']],
    [
      'a missing required port',
      { r: { type: 'Repeat', children: ['x'] }, x: { type: 'Turn' } },
      ['r missing-port num_cycles'],
    ],
    [
      'an empty number',
      { r: { type: 'Repeat', ports: { num_cycles: '' }, children: ['x'] }, x: { type: 'Turn' } },
      ['r wrong-type num_cycles'],
    ],
    [
      'an unclosed brace',
      under({ type: 'Turn', ports: { ang_speed: '{speed' } }),
      ['x unclosed-brace ang_speed'],
    ],
    ['an empty key', under({ type: 'Turn', ports: { ang_speed: '{}' } }), ['x empty-key ang_speed']],
    ['a wrong type', under({ type: 'Turn', ports: { ang_speed: 'fast' } }), ['x wrong-type ang_speed']],
    ['an unknown port', under({ type: 'Turn', ports: { speed: '1' } }), ['x unknown-port speed']],
    ['any port of an open action', under({ type: 'Free', ports: { speed: '1' } }), []],
    [
      'an output with a fixed value',
      { r: { type: 'LoopInt', ports: { queue: '1;2', value: '3' }, children: ['x'] }, x: { type: 'Turn' } },
      ['r output-literal value'],
    ],
    ['a subtree without a tree', under({ type: 'SubTree' }), ['x missing-tree']],
    ['an unknown tree', under({ type: 'SubTree', tree: 'Gone' }), ['x unknown-tree']],
    ['a tree inside itself', under({ type: 'SubTree', tree: 'MainTree' }), ['x recursion']],
  ])('reports %s', (_what, nodes, expected) => {
    expect(kinds(nodes)).toEqual(expected);
  });

  it('lists drafts as notes, and checks nothing in them', () => {
    expect(kinds({ ...under({ type: 'Turn' }), d: { type: 'Nope' } }, 'r', ['d'])).toEqual(['d draft']);
  });
  it('lists an empty tree as a note', () => {
    expect(kinds({}, null)).toEqual(['empty-tree']);
  });
});
