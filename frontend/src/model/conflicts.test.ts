import { describe, expect, it } from 'vitest';
import { conflictsOf, decide, shownSide, type Side } from './conflicts';
import { emptyDiagram, preorder, type Diagram } from './diagram';
import { edit } from './edits';

const entry = { op: 'change', node: 'a', field: 'ports.speed', base: '1', ours: '2', theirs: '3' };

function tree(conflicts: unknown): Diagram {
  return {
    ...emptyDiagram('Main'),
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b', 's'] },
      a: { type: 'Forward', name: 'ahead', ports: { speed: '2' } },
      b: { type: 'Turn' },
      s: { type: 'Fallback', children: ['c'] },
      c: { type: 'Talk' },
      d: { type: 'Wait' },
    },
    drafts: ['d'],
    conflicts,
  };
}

const decided = (conflict: object, side: Side): Diagram =>
  edit(tree([{ node: '', base: null, ours: null, theirs: null, ...conflict }]), decide(0, side)).diagram;

describe('conflictsOf', () => {
  it('reads entries of any form', () => {
    expect(conflictsOf(tree([entry]))).toEqual([entry]);
    expect(conflictsOf(tree([5]))).toEqual([
      { op: '', node: '', field: '', base: null, ours: null, theirs: null },
    ]);
    expect(conflictsOf(tree('?'))).toEqual([]);
    expect(conflictsOf(emptyDiagram('Main'))).toEqual([]);
  });
});

describe('decide', () => {
  it('takes the entry out, and leaves ours', () => {
    const { diagram } = edit(tree([entry, { op: '?' }]), decide(0, 'ours'));
    expect(diagram.nodes['a']?.ports).toEqual({ speed: '2' });
    expect(diagram.conflicts).toEqual([{ op: '?' }]);
    expect(edit(diagram, decide(0, 'theirs')).diagram).not.toHaveProperty('conflicts');
    expect(edit(diagram, decide(7, 'theirs')).diagram).toBe(diagram);
  });

  it('takes the fields of theirs, of nodes and of the tree', () => {
    expect(decided(entry, 'theirs').nodes['a']?.ports).toEqual({ speed: '3' });
    expect(decided({ ...entry, theirs: null }, 'theirs').nodes['a']).not.toHaveProperty('ports');
    expect(decided({ op: 'rename', node: 'a', theirs: 'on' }, 'theirs').nodes['a']?.name).toBe('on');
    expect(decided({ op: 'rename', node: 'a' }, 'theirs').nodes['a']).not.toHaveProperty('name');
    expect(decided({ op: 'change', field: 'attributes._x.y', theirs: '1' }, 'theirs').attributes).toEqual({
      '_x.y': '1',
    });
    expect(
      decided({ op: 'change', node: 'b', field: 'type', theirs: 'Spin' }, 'theirs').nodes['b']?.type,
    ).toBe('Spin');
  });

  it('takes ports of the tree from the list', () => {
    const ports = [{ name: 'p' }, { name: 'q' }];
    const conflict = { ...entry, node: '', field: 'ports.p', theirs: { name: 'p', type: 'int' } };
    const { diagram } = edit({ ...tree([conflict]), ports }, decide(0, 'theirs'));
    expect(diagram.ports).toEqual([{ name: 'q' }, { name: 'p', type: 'int' }]);
  });

  it('moves, orders, and makes another root', () => {
    const move = { op: 'move', node: 'a', theirs: { parent: 's', index: 1 } };
    expect(decided(move, 'theirs').nodes['s']?.children).toEqual(['c', 'a']);
    expect(decided({ ...move, theirs: { parent: null, index: 0 } }, 'theirs').drafts).toEqual(['d', 'a']);
    expect(decided({ ...move, theirs: { parent: 'gone', index: 0 } }, 'theirs').nodes).toEqual(
      tree([]).nodes,
    );
    const order = { op: 'reorder', node: 'r', theirs: ['s', 'x', 'a'] };
    expect(decided(order, 'theirs').nodes['r']?.children).toEqual(['s', 'b', 'a']);
    const top = decided({ op: 'root', node: 'd', ours: 'r', theirs: 'd' }, 'theirs');
    expect([top.root, top.drafts]).toEqual(['d', ['r']]);
  });

  it('turns a ring round', () => {
    const ring = { op: 'ring', node: 's', theirs: { parent: 'c', index: 0 } };
    const { nodes } = decided(ring, 'theirs');
    expect(nodes['r']?.children).toEqual(['a', 'b', 'c']);
    expect(nodes['c']?.children).toEqual(['s']);
    expect(nodes['s']).not.toHaveProperty('children');
  });

  it('deletes only what the chosen side deleted', () => {
    const gone = { op: 'delete', node: 's', ours: null, theirs: { type: 'Fallback' } };
    expect(preorder(decided(gone, 'ours'))).toEqual(['r', 'a', 'b', 'd']);
    expect(preorder(decided(gone, 'theirs'))).toEqual(preorder(tree([])));
  });

  it('makes drafts of the children that the chosen side does not have', () => {
    const many = { op: 'children', node: 'r', ours: ['a', 's'], theirs: ['b'] };
    expect(decided(many, 'ours').nodes['r']?.children).toEqual(['a', 's']);
    expect(decided(many, 'theirs').drafts).toEqual(['d', 'a', 's']);
  });
});

describe('a tree from XML', () => {
  const imported = (text: string): Diagram => ({
    ...tree(undefined),
    attributes: { _bts_conflicts: text, _other: '1' },
  });

  it('has its decisions in an attribute', () => {
    const diagram = imported(JSON.stringify([entry, { ...entry, field: 'ports.angle' }]));
    expect(conflictsOf(diagram).map(({ field }) => field)).toEqual(['ports.speed', 'ports.angle']);
    const first = edit(diagram, decide(0, 'theirs')).diagram;
    expect(first.nodes['a']?.ports).toEqual({ speed: '3' });
    expect(conflictsOf(first)).toHaveLength(1);
    expect(edit(first, decide(0, 'ours')).diagram.attributes).toEqual({ _other: '1' });
  });

  it.each(['{', '5', ''])('has one to look at if it cannot be read: %s', (text) => {
    expect(conflictsOf(imported(text))).toHaveLength(1);
    expect(edit(imported(text), decide(0, 'ours')).diagram.attributes).toEqual({ _other: '1' });
  });
});

describe('shownSide', () => {
  it.each([
    [entry, { is: 'text', text: '3' }],
    [
      { op: 'change', theirs: { a: 1 } },
      { is: 'text', text: '{"a":1}' },
    ],
    [
      { op: 'move', theirs: { parent: 'a', index: 1 } },
      { is: 'place', parent: 'ahead', place: 2 },
    ],
    [{ op: 'move', theirs: { parent: '', index: 0 } }, { is: 'top' }],
    [{ op: 'move', theirs: { parent: null, index: 0 } }, { is: 'draft' }],
    [
      { op: 'reorder', theirs: ['b', 'a', 'x'] },
      { is: 'text', text: 'Turn, ahead, x' },
    ],
    [
      { op: 'root', theirs: 'a' },
      { is: 'text', text: 'ahead' },
    ],
    [{ op: 'rename', theirs: null }, { is: 'nothing' }],
    [{ op: 'delete', theirs: null }, { is: 'deleted' }],
    [{ op: 'delete', theirs: {} }, { is: 'kept' }],
  ])('of %j', (conflict, shown) => {
    const diagram = tree([conflict]);
    expect(conflictsOf(diagram).map((each) => shownSide(diagram, each, 'theirs'))).toEqual([shown]);
  });
});
