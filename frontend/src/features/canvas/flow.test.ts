import { Position } from '@xyflow/react';
import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { expandTrees } from '@/model/expand';
import { layoutTree } from '@/model/layout';
import { vocabulary } from '@/model/testing';
import type { ShownProblem } from '@/store/project/problems';
import { FlowProjection, ordinal, withHeld, type FlowInput } from './flow';

const main: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 's', 'f'], name: 'Work' },
    a: { type: 'Turn' },
    s: { type: 'SubTree', tree: 'Inner' },
    f: { type: 'Fallback', children: ['x', 'y'] },
    x: { type: 'Turn' },
    y: { type: 'Inverter', children: ['z'] },
    z: { type: 'Nowhere' },
    d: { type: 'Sequence', children: ['e'] },
    e: { type: 'Turn' },
  },
  drafts: ['d'],
};
const inner: Diagram = { ...emptyDiagram('Inner'), root: 'i', nodes: { i: { type: 'AlwaysSuccess' } } };
const problem: ShownProblem = {
  source: 'server',
  severity: 'error',
  node: 'a',
  code: 'X',
  message: 'm',
  hint: '',
};

function input(diagram: Diagram, more: Partial<FlowInput> = {}, open: readonly string[] = []): FlowInput {
  const shown = expandTrees(diagram, { Inner: inner, MainTree: diagram }, new Set(open));
  return {
    diagram,
    shown,
    layout: layoutTree(shown.diagram, vocabulary),
    vocabulary,
    problems: new Map(),
    selection: new Set(),
    ...more,
  };
}

const patched = (id: string, patch: object): Diagram => ({
  ...main,
  nodes: { ...main.nodes, [id]: { ...main.nodes[id]!, ...patch } },
});

function project(given: FlowInput, projection = new FlowProjection()) {
  const { nodes, edges } = projection.project(given);
  const node = (id: string) => nodes.find((each) => each.id === id)!;
  const edge = (id: string) => edges.find((each) => each.id === id)!;
  return { nodes, edges, node, edge };
}

describe('FlowProjection', () => {
  it('gives each block its place, size, name and specification', () => {
    const given = input(main);
    const { nodes, node } = project(given);
    expect(nodes.map(({ id }) => id).sort()).toEqual(Object.keys(main.nodes).sort());
    const box = given.layout.positions['a']!;
    expect(node('a')).toMatchObject({
      type: 'block',
      position: { x: box.x, y: box.y },
      width: box.width,
      height: box.height,
      measured: { width: box.width, height: box.height },
      selected: false,
      ariaLabel: 'Turn',
      ariaRole: 'group',
    });
    expect(node('r').ariaLabel).toBe('Work');
    expect(node('s').ariaLabel).toBe('Inner');
    expect(node('a').data).toMatchObject({ tree: 'MainTree', node: main.nodes['a'], inside: null });
    expect(node('a').data.spec?.type).toBe('Turn');
    expect(node('z').data.spec).toBeUndefined();
    expect(node('a')).not.toHaveProperty('draggable');
  });

  it('connects from top to bottom, or from left to right', () => {
    const { node } = project(input(main));
    const { width = 0, height = 0 } = node('r');
    expect(node('r').handles).toEqual([
      { type: 'target', position: Position.Top, x: width / 2, y: 0, width: 0, height: 0 },
      { type: 'source', position: Position.Bottom, x: width / 2, y: height, width: 0, height: 0 },
    ]);
    const turned = project(input({ ...main, layout: 'horizontal' }));
    expect(turned.node('r').data.isHorizontal).toBe(true);
    expect(turned.edge('a').data?.isHorizontal).toBe(true);
    expect(turned.node('r').handles).toEqual([
      { type: 'target', position: Position.Left, x: 0, y: height / 2, width: 0, height: 0 },
      { type: 'source', position: Position.Right, x: width, y: height / 2, width: 0, height: 0 },
    ]);
  });

  it('has an edge to each child, with the id of the child', () => {
    const { edges, edge } = project(input(main));
    expect(edges.map(({ id, source, target }) => [id, source, target])).toEqual(
      expect.arrayContaining([
        ['a', 'r', 'a'],
        ['z', 'y', 'z'],
        ['e', 'd', 'e'],
      ]),
    );
    expect(edges).toHaveLength(7);
    expect(edge('a')).toMatchObject({
      type: 'tree',
      data: { tree: 'MainTree', node: 'a', isHorizontal: false },
      focusable: false,
      selectable: true,
    });
  });

  it('marks drafts with their subtrees, and blocks that can have more children', () => {
    const { node } = project(input(main));
    expect(['r', 'a', 'd', 'e'].map((id) => node(id).data.isDraft)).toEqual([false, false, true, true]);
    expect(['r', 'a', 'y', 'z'].map((id) => node(id).data.canGrow)).toEqual([true, false, false, false]);
  });

  it('counts the blocks that a folded block hides, and draws none of them', () => {
    const { node, nodes } = project(input(patched('f', { collapsed: true })));
    expect(node('f').data.folded).toBe(3);
    expect(node('r').data.folded).toBe(0);
    expect(nodes.map(({ id }) => id)).not.toContain('x');
  });

  it('shows problems and the selection', () => {
    const { node } = project(
      input(main, { problems: new Map([['a', problem]]), selection: new Set(['s', 'f']) }),
    );
    expect(node('a').data.problem).toBe(problem);
    expect(node('s').data.problem).toBeNull();
    expect(['r', 's', 'f'].map((id) => node(id).selected)).toEqual([false, true, true]);
  });

  it('expands a SubTree whose tree is known, and fixes the blocks inside', () => {
    const closed = project(input(main));
    expect(['s', 'a'].map((id) => closed.node(id).data.look)).toEqual(['closed', null]);
    const { node, edge } = project(input(main, {}, ['s']));
    expect(node('s').data.look).toBe('open');
    expect(node('s i')).toMatchObject({ draggable: false, selectable: false, connectable: false });
    expect(node('s i').data.inside).toEqual({ tree: 'Inner', node: 'i' });
    expect(edge('s i')).toMatchObject({ selectable: false, data: { tree: 'Inner', node: 'i' } });
    const lost = project(input(patched('s', { tree: 'Lost' })));
    expect(lost.node('s').data.look).toBeNull();
    expect(project(input(patched('s', { tree: '' }))).node('s').data.look).toBeNull();
    expect(project(input(patched('a', { tree: 'Inner' }))).node('a').data.look).toBeNull();
  });

  it('leaves out a position without a node', () => {
    const given = input(main);
    const positions = { ...given.layout.positions, ghost: { x: 0, y: 0, width: 1, height: 1 } };
    const { nodes } = project({ ...given, layout: { ...given.layout, positions } });
    expect(nodes).toHaveLength(9);
  });
});

describe('what has not changed', () => {
  it('stays the same list of the same objects', () => {
    const projection = new FlowProjection();
    const given = input(main, {}, ['s']);
    const before = project(given, projection);
    const inside = new Map([...given.shown.inside].map(([id, place]) => [id, { ...place }]));
    const after = project({ ...given, shown: { ...given.shown, inside } }, projection);
    expect(after.nodes).toBe(before.nodes);
    expect(after.edges).toBe(before.edges);
  });

  it('stays if another block changes', () => {
    const projection = new FlowProjection();
    const before = project(input(main), projection);
    const after = project(input(patched('x', { disabled: true })), projection);
    expect(after.nodes).not.toBe(before.nodes);
    expect(after.edges).toBe(before.edges);
    expect(after.node('x')).not.toBe(before.node('x'));
    expect(after.node('x').data.node.disabled).toBe(true);
    expect(after.nodes.filter((each) => each.id !== 'x')).toEqual(
      before.nodes.filter((each) => each.id !== 'x'),
    );
    for (const each of after.nodes) if (each.id !== 'x') expect(each).toBe(before.node(each.id));
  });

  it('keeps its data if only the place or the selection changes', () => {
    const projection = new FlowProjection();
    const before = project(input(main), projection);
    const chosen = project(input(main, { selection: new Set(['a']) }), projection);
    expect(chosen.node('a')).not.toBe(before.node('a'));
    expect(chosen.node('a').data).toBe(before.node('a').data);
    expect(chosen.node('r')).toBe(before.node('r'));
    const given = input(main, { selection: new Set(['a']) });
    for (const patch of [{ x: 1 }, { y: 2 }, { width: 3 }, { height: 4 }]) {
      const box = { ...given.layout.positions['s']!, ...patch };
      const layout = { ...given.layout, positions: { ...given.layout.positions, s: box } };
      const moved = project({ ...given, layout }, projection).node('s');
      expect(moved).toMatchObject({
        position: { x: box.x, y: box.y },
        width: box.width,
        height: box.height,
      });
      expect(moved.data).toBe(before.node('s').data);
    }
  });

  it('is another edge if the parent or the direction changes', () => {
    const projection = new FlowProjection();
    const before = project(input(main), projection);
    const moved: Diagram = {
      ...main,
      nodes: {
        ...main.nodes,
        r: { ...main.nodes['r']!, children: ['s', 'f'] },
        f: { ...main.nodes['f']!, children: ['x', 'y', 'a'] },
      },
    };
    const after = project(input(moved), projection);
    expect(after.edge('a').source).toBe('f');
    expect(after.edge('x')).toBe(before.edge('x'));
    const turned = project(input({ ...moved, layout: 'horizontal' }), projection);
    expect(turned.edge('x')).not.toBe(before.edge('x'));
  });
});

it('marks only the dragged block', () => {
  const { nodes } = project(input(main));
  expect(withHeld(nodes, null)).toBe(nodes);
  const held = withHeld(nodes, 'a');
  expect(held.filter(({ dragging }) => dragging).map(({ id }) => id)).toEqual(['a']);
  expect(held[0]).toBe(nodes[0]);
});

it('counts places from one', () => {
  expect(ordinal(main, 'r', 's')).toEqual({ index: 2, count: 3 });
  expect(ordinal(main, null, 'd')).toEqual({ index: 1, count: 1 });
});
