import { describe, expect, it } from 'vitest';
import { emptyDiagram, preorder, type Diagram } from './diagram';
import { expandTrees } from './expand';
import { layoutTree } from './layout';
import { vocabulary } from './testing';

const main: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['s', 't'] },
    s: { type: 'SubTree', tree: 'Dock' },
    t: { type: 'Turn' },
  },
};
const dock: Diagram = {
  ...emptyDiagram('Dock'),
  root: 'a',
  nodes: {
    a: { type: 'Sequence', children: ['b', 'c'], position: [900, 900] },
    b: { type: 'Turn' },
    c: { type: 'SubTree', tree: 'Align' },
    loose: { type: 'Turn' },
  },
  drafts: ['loose'],
};
const align: Diagram = { ...emptyDiagram('Align'), root: 'x', nodes: { x: { type: 'Turn' } } };
const all = { MainTree: main, Dock: dock, Align: align };

describe('expanding a subtree', () => {
  it('leaves a tree unchanged while nothing is expanded', () => {
    expect(expandTrees(main, all, new Set()).diagram).toBe(main);
  });

  it('adds its tree below it, without drafts, with the real place of each block', () => {
    const { diagram, inside, groups } = expandTrees(main, all, new Set(['s']));
    expect(preorder(diagram)).toEqual(['r', 's', 's a', 's b', 's c', 't']);
    expect(inside.get('s b')).toEqual({ tree: 'Dock', node: 'b' });
    expect(groups.get('s')).toEqual(['s a', 's b', 's c']);
    expect(main.nodes['s']?.children).toBeUndefined();
  });

  it('expands a tree inside of a tree', () => {
    const { inside, groups } = expandTrees(main, all, new Set(['s', 's c']));
    expect(inside.get('s c x')).toEqual({ tree: 'Align', node: 'x' });
    expect(groups.get('s')).toContain('s c x');
  });

  it('shows nothing inside of a tree that is missing, or empty', () => {
    expect(expandTrees(main, { MainTree: main }, new Set(['s'])).inside.size).toBe(0);
    const bare = { ...all, Dock: emptyDiagram('Dock') };
    expect(expandTrees(main, bare, new Set(['s'])).inside.size).toBe(0);
  });

  it('ignores manual positions in the inner tree', () => {
    const { diagram } = expandTrees(main, all, new Set(['s']));
    const { positions } = layoutTree(diagram, vocabulary);
    expect(positions['s a']?.y).toBeGreaterThan(positions['s']?.y ?? 0);
    expect(positions['s a']?.x).toBeLessThan(900);
  });
});
