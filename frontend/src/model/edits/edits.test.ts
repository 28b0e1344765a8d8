import fc from 'fast-check';
import { applyPatches } from 'immer';
import { describe, expect, it } from 'vitest';
import { emptyDiagram, parentOf, type Diagram } from '../diagram';
import { parseDiagram, serializeDiagram } from '../serialize';
import { illegality, legalStep, steps } from '../testing';
import { edit, type Recipe } from './core';
import {
  addNode,
  addPort,
  extractSubtree,
  inlineSubtree,
  moveNode,
  moveNodes,
  removeSubtrees,
  removePort,
  renamePort,
  renameUse,
  reorder,
  setColor,
  setCondition,
  setLayout,
  setName,
  setPort,
  setPosition,
  unwrap,
  wrap,
} from './index';

const RUNS = Number(process.env.BT_STUDIO_FULL ? 10_000 : 300);

const tree = (): Diagram =>
  parseDiagram({
    format: 'bt-studio/diagram',
    version: 1,
    id: 'MainTree',
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b', 'c'] },
      a: { type: 'Turn', ports: { ang_speed: '{speed}' } },
      b: { type: 'Fallback', children: ['d'] },
      c: { type: 'Turn' },
      d: { type: 'Free', ports: { goal: '{goal}' } },
    },
    drafts: [],
  });

const after = (...recipes: Recipe[]): Diagram => edit(tree(), ...recipes).diagram;
const childrenAfter = (id: string, ...recipes: Recipe[]) => after(...recipes).nodes[id]?.children;

describe('random legal edits', () => {
  it('keep the tree a legal forest, survive a save, and undo to the start', () => {
    fc.assert(
      fc.property(steps, (chosen) => {
        const start = tree();
        let now = start;
        const inverses: ReturnType<typeof edit>[] = [];
        for (const [what, where, which] of chosen) {
          const recipe = legalStep(now, what, where, which);
          if (!recipe) continue;
          const edited = edit(now, recipe);
          expect(illegality(edited.diagram)).toBeNull();
          inverses.push(edited);
          now = edited.diagram;
        }
        expect(parseDiagram(serializeDiagram(now))).toEqual(now);
        let elsewhere: Diagram = start;
        for (const { patches } of inverses) elsewhere = applyPatches(elsewhere, [...patches]);
        expect(elsewhere).toEqual(now);
        for (const { inverse } of inverses.reverse()) now = applyPatches(now, [...inverse]);
        expect(now).toEqual(start);
      }),
      { numRuns: RUNS },
    );
  });
});

describe('moving', () => {
  it('counts the index among the children before the move', () => {
    expect(childrenAfter('r', moveNode('a', { at: 'child', parent: 'r', index: 2 }))).toEqual([
      'b',
      'a',
      'c',
    ]);
    expect(childrenAfter('r', moveNode('c', { at: 'child', parent: 'r', index: 0 }))).toEqual([
      'c',
      'a',
      'b',
    ]);
  });
  it('moves the subtree', () => {
    const moved = after(moveNode('b', { at: 'draft', position: [10, 20] }));
    expect(moved.drafts).toEqual(['b']);
    expect(moved.nodes['b']).toEqual({ type: 'Fallback', children: ['d'], position: [10, 20] });
  });
  it('keeps several blocks in order, wherever each of them was', () => {
    const to = (index: number) => ({ at: 'child', parent: 'r', index }) as const;
    expect(childrenAfter('r', moveNodes(['a', 'b'], to(3)))).toEqual(['c', 'a', 'b']);
    expect(childrenAfter('r', moveNodes(['b', 'c'], to(0)))).toEqual(['b', 'c', 'a']);
    expect(childrenAfter('r', moveNodes(['a', 'c'], to(2)))).toEqual(['b', 'a', 'c']);
    expect(childrenAfter('r', moveNodes(['a', 'd'], to(2)))).toEqual(['b', 'a', 'd', 'c']);
  });
  it('stops reordering at the ends', () => {
    expect(childrenAfter('r', reorder(['a'], -1))).toEqual(['a', 'b', 'c']);
    expect(childrenAfter('r', reorder(['a'], 9))).toEqual(['b', 'c', 'a']);
  });
  it('reorders several siblings together, or none', () => {
    expect(childrenAfter('r', reorder(['b', 'a'], 1))).toEqual(['c', 'a', 'b']);
    expect(childrenAfter('r', reorder(['b', 'c'], -1))).toEqual(['b', 'c', 'a']);
    expect(childrenAfter('r', reorder(['a', 'c'], 1))).toEqual(['a', 'b', 'c']);
  });
});

describe('wrapping', () => {
  it('puts a node above one block', () => {
    const wrapped = after(wrap(['b'], 'w', { type: 'Inverter' }));
    expect(wrapped.nodes['r']?.children).toEqual(['a', 'w', 'c']);
    expect(wrapped.nodes['w']).toEqual({ type: 'Inverter', children: ['b'] });
  });
  it('puts a node above several siblings at the place of the first', () => {
    const wrapped = after(wrap(['c', 'a'], 'w', { type: 'Sequence' }));
    expect(wrapped.nodes['r']?.children).toEqual(['w', 'b']);
    expect(wrapped.nodes['w']?.children).toEqual(['a', 'c']);
  });
  it('replaces the root by the new one', () => {
    expect(after(wrap(['r'], 'w', { type: 'Repeat' })).root).toBe('w');
  });
  it('is undone by unwrapping', () => {
    expect(after(wrap(['b'], 'w', { type: 'Inverter' }), unwrap('w'))).toEqual(tree());
  });
  it('leaves the children of a removed root as root and drafts', () => {
    const left = after(unwrap('r'));
    expect([left.root, left.drafts]).toEqual(['a', ['b', 'c']]);
  });
});

describe('removing', () => {
  it('removes the subtree', () => {
    expect(Object.keys(after(removeSubtrees(['b', 'd'])).nodes)).toEqual(['r', 'a', 'c']);
  });
  it('of the root leaves an empty tree', () => {
    expect(after(removeSubtrees(['r']))).toEqual(emptyDiagram('MainTree'));
  });
});

describe('adding', () => {
  it('makes the old root a draft when a new one is put in its place', () => {
    const added = after(addNode('n', { type: 'Sequence' }, { at: 'root' }));
    expect([added.root, added.drafts]).toEqual(['n', ['r']]);
  });
});

describe('fields', () => {
  it('leaves out a name that equals the type', () => {
    expect(after(setName('a', ' Turn ')).nodes['a']).not.toHaveProperty('name');
    expect(after(setName('a', 'left')).nodes['a']?.name).toBe('left');
  });
  it('drops a record with its last entry', () => {
    expect(after(setPort('a', 'ang_speed', null)).nodes['a']).toEqual({ type: 'Turn' });
    expect(after(setCondition('a', '_skipIf', 'x'), setCondition('a', '_skipIf', null))).toEqual(tree());
  });
  it('renames ports and types wherever they are used', () => {
    const renamed = after(renamePort('Turn', 'ang_speed', 'speed'), renameUse('action', 'Turn', 'Spin'));
    expect(renamed.nodes['a']).toEqual({ type: 'Spin', ports: { speed: '{speed}' } });
    expect(renamed.nodes['c']?.type).toBe('Spin');
  });
  it('adds a port to every block of a type, and removes it from all', () => {
    const given = after(setPort('c', 'goal', 'door'), addPort('Turn', 'goal'));
    expect(given.nodes['a']?.ports).toEqual({ ang_speed: '{speed}', goal: '{goal}' });
    expect(given.nodes['c']?.ports?.['goal']).toBe('door');
    expect(after(addPort('Turn', 'goal'), removePort('Turn', 'goal'))).toEqual(tree());
  });
  it('drops manual positions when the layout is turned', () => {
    const turned = after(setPosition('a', [1.4, 2.6]), setLayout('horizontal'));
    expect([turned.layout, turned.nodes['a']?.position]).toEqual(['horizontal', undefined]);
    expect(after(setColor('a', '#fff'), setColor('a', null))).toEqual(tree());
  });
});

describe('subtrees', () => {
  it.each([
    ['ReactiveFallback', 'ReactiveFallback'],
    ['SequenceWithMemory', 'SequenceWithMemory'],
    ['Parallel', 'Parallel'],
    ['IfThenElse', 'Sequence'],
  ])('extracts children of a %s as a %s, which executes them as before', (parent, root) => {
    const diagram = edit(tree(), (draft) => {
      draft.nodes['r']!.type = parent;
    }).diagram;
    const names = ['s1', 's2'];
    const extracted = extractSubtree(diagram, ['a', 'b'], 'Sub', () => names.shift() ?? 'n');
    expect(extracted?.tree.nodes['s1']).toMatchObject({ type: root, children: ['a', 'b'] });
  });

  it('extracts siblings with the keys they use, and inlines them back', () => {
    const diagram = tree();
    const names = ['s1', 's2'];
    const extracted = extractSubtree(diagram, ['a', 'b'], 'Sub', () => names.shift() ?? 'n');
    const outer = edit(diagram, extracted!.recipe).diagram;
    expect(outer.nodes['s2']).toEqual({
      type: 'SubTree',
      tree: 'Sub',
      ports: { goal: '{goal}', speed: '{speed}' },
    });
    expect(outer.nodes['r']?.children).toEqual(['s2', 'c']);
    expect(illegality(extracted!.tree)).toBeNull();
    let count = 0;
    const back = edit(
      outer,
      inlineSubtree('s2', extracted!.tree, () => `i${(count += 1)}`),
    ).diagram;
    expect(illegality(back)).toBeNull();
    expect(
      Object.values(back.nodes)
        .map((node) => node.type)
        .sort(),
    ).toEqual(['Fallback', 'Free', 'Sequence', 'Sequence', 'Turn', 'Turn']);
  });
  it('passes remapped keys when inlining', () => {
    const sub = parseDiagram({
      format: 'bt-studio/diagram',
      version: 1,
      id: 'Sub',
      root: 'x',
      nodes: { x: { type: 'Free', ports: { goal: '{target}', same: '{=}', other: '{own}' } } },
    });
    const outer = after(
      addNode(
        's',
        { type: 'SubTree', tree: 'Sub', ports: { target: '{home}', same: '3' } },
        { at: 'child', parent: 'b', index: 0 },
      ),
    );
    const inlined = edit(
      outer,
      inlineSubtree('s', sub, () => 'i1'),
    ).diagram;
    expect(inlined.nodes['i1']?.ports).toEqual({ goal: '{home}', same: '3', other: '{own}' });
    expect(parentOf(inlined, 'i1')).toBe('b');
  });
});
