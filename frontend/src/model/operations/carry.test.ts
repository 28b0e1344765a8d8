import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { done, edited, plain, RUNS, start } from '../../../harness/edited';
import type { Diagram } from '../diagram';
import { moveNode, removeSubtrees, setName, setPort, wrap } from '../edits';
import { edit, type Recipe } from '../edits/core';
import { illegality, steps } from '../testing';
import { emptyUndo, redo, undo, type UndoStack } from '../undo';
import { carriedStack } from './carry';

const nobody = () => false;

function carry(undoStack: UndoStack, mine: Diagram, now: Diagram) {
  return carriedStack(undoStack, { Main: mine }, { Main: now }, nobody);
}

describe('an undo stack that is carried over', () => {
  it('stays as it is in effect where nobody else changed the tree', () => {
    fc.assert(
      fc.property(steps, (mine) => {
        const { diagram, undoStack } = edited(start, mine);
        const copy = structuredClone(diagram);
        const { undoStack: carried, lost } = carry(undoStack, diagram, copy);
        expect(lost).toBe(0);
        let all: Readonly<Record<string, Diagram>> = { Main: copy };
        let stack = carried;
        for (let step = undo(all, stack); step; step = undo(all, stack)) {
          all = step.document;
          stack = step.undoStack;
        }
        expect(plain(all['Main'] ?? start)).toEqual(plain(start));
        for (let step = redo(all, stack); step; step = redo(all, stack)) {
          all = step.document;
          stack = step.undoStack;
        }
        expect(plain(all['Main'] ?? start)).toEqual(plain(diagram));
      }),
      { numRuns: RUNS },
    );
  });

  it('undoes nothing that others did, and leaves a legal tree', () => {
    fc.assert(
      fc.property(steps, steps, (mine, theirs) => {
        const { diagram, undoStack } = edited(start, mine);
        const now = edited(diagram, theirs).diagram;
        const { undoStack: carried, lost } = carry(undoStack, diagram, now);
        expect(carried.past.length + lost).toBe(undoStack.past.length);
        const added = Object.keys(now.nodes).filter((id) => !(id in diagram.nodes));
        let all: Readonly<Record<string, Diagram>> = { Main: now };
        let stack = carried;
        for (let step = undo(all, stack); step; step = undo(all, stack)) {
          all = step.document;
          stack = step.undoStack;
          const nodes = all['Main']?.nodes ?? {};
          for (const id of added) expect(nodes[id]).toBeDefined();
          expect(illegality(all['Main'] ?? start) ?? '').not.toMatch(/twice|not there/);
        }
      }),
      { numRuns: RUNS },
    );
  });

  const tree: Diagram = {
    ...start,
    nodes: {
      root: { type: 'Sequence', children: ['a', 'b', 'c'] },
      a: { type: 'Sleep', ports: { msec: '1', other: '1' } },
      b: { type: 'AlwaysSuccess' },
      c: { type: 'AlwaysFailure' },
    },
  };

  it.each<[string, Recipe, Recipe, number, (undone: Diagram) => unknown, unknown]>([
    [
      'another port',
      setPort('a', 'msec', '2'),
      setPort('a', 'other', '9'),
      0,
      (d) => d.nodes['a']?.ports,
      { msec: '1', other: '9' },
    ],
    [
      'the same port',
      setPort('a', 'msec', '2'),
      setPort('a', 'msec', '3'),
      1,
      (d) => d.nodes['a']?.ports,
      { msec: '3', other: '1' },
    ],
    [
      'a sibling that is gone',
      removeSubtrees(['b']),
      removeSubtrees(['a']),
      0,
      (d) => d.nodes['root']?.children,
      ['c', 'b'],
    ],
    [
      'the parent that is gone',
      removeSubtrees(['b']),
      removeSubtrees(['root']),
      1,
      (d) => Object.keys(d.nodes),
      [],
    ],
    [
      'the same block moved',
      moveNode('a', { at: 'child', parent: 'root', index: 3 }),
      removeSubtrees(['a']),
      1,
      (d) => d.nodes['root']?.children,
      ['b', 'c'],
    ],
    [
      'a child that others gave',
      wrap(['a'], 'w', { type: 'Sequence' }),
      moveNode('c', { at: 'child', parent: 'w', index: 1 }),
      1,
      (d) => d.nodes['w']?.children,
      ['a', 'c'],
    ],
  ])('%s', (_, mine, theirs, lost, look, expected) => {
    const own = done(tree, emptyUndo, mine);
    const now = edit(own.diagram, theirs).diagram;
    const carried = carry(own.undoStack, own.diagram, now);
    expect(carried.lost).toBe(lost);
    const after = undo({ Main: now }, carried.undoStack)?.document['Main'] ?? now;
    expect(look(after)).toEqual(expected);
  });

  it('loses a step that wrote a file which others changed', () => {
    const { diagram, undoStack } = done(start, emptyUndo, setName('root', 'x'));
    const [entry] = undoStack.past;
    const files = [{ path: 'actions/A.py', before: null, after: 'a' }];
    const past = entry ? [{ ...entry, files }] : [];
    const trees = { Main: diagram };
    const of = (theirs: string) =>
      carriedStack({ ...undoStack, past }, trees, { Main: { ...diagram } }, (path) => path === theirs).lost;
    expect([of('actions/A.py'), of('actions/B.py')]).toEqual([1, 0]);
  });

  it('keeps steps of other trees as they are, and loses those of a tree that is gone', () => {
    const { diagram, undoStack } = done(start, emptyUndo, setName('root', 'x'));
    const other = { ...start, id: 'Other' };
    const kept = carriedStack(undoStack, { Main: diagram, Other: other }, { Main: diagram }, nobody);
    expect(undo({ Main: diagram }, kept.undoStack)?.document['Main']?.nodes['root']?.name).toBeUndefined();
    expect(kept.lost).toBe(0);
    expect(carriedStack(undoStack, { Main: diagram }, {}, nobody).lost).toBe(1);
  });
});
