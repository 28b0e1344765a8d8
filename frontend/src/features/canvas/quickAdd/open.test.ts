import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../../harness/canvas';
import { openQuickAdd, openQuickAddBelow, openQuickAddHere, pointOf } from './open';

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['i', 'a'] },
      i: { type: 'Inverter', children: ['x'] },
      x: { type: 'Sleep' },
      a: { type: 'Sleep' },
    },
  });
});

afterEach(() => {
  document.body.innerHTML = '';
});

/** Adds an element with a box in the window. */
function draw(testId: string, box: DOMRect) {
  const element = document.body.appendChild(document.createElement('div'));
  element.dataset['testid'] = testId;
  element.getBoundingClientRect = () => box;
}

const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);
const goal = () => now.editor().quickAdd?.goal;

describe('pointOf', () => {
  it('is below the block', () => {
    draw('canvas', new DOMRect(0, 0, 800, 600));
    draw('node-a', new DOMRect(30, 40, 140, 44));
    expect(pointOf('a')).toEqual({ x: 30, y: 92 });
  });

  it('is in the upper middle of the canvas for no block, or for one that is not drawn', () => {
    draw('canvas', new DOMRect(100, 50, 800, 600));
    for (const id of ['gone', undefined]) expect(pointOf(id)).toEqual({ x: 340, y: 130 });
  });

  it('is at a fixed place without a canvas', () => {
    expect(pointOf('a')).toEqual({ x: 200, y: 200 });
  });
});

it('opens at a point with the typed text', () => {
  openQuickAdd('Main', { does: 'wrap', nodes: ['a'] }, 3, 4, 'Re');
  expect(now.editor().quickAdd).toEqual({
    tree: 'Main',
    goal: { does: 'wrap', nodes: ['a'] },
    x: 3,
    y: 4,
    text: 'Re',
  });
});

it('opens for a child after the others', () => {
  openQuickAddBelow('Main', 'r', 3, 4);
  expect(goal()).toEqual({ does: 'add', place: { at: 'child', parent: 'r', index: 2 } });
  expect(now.editor().quickAdd).toMatchObject({ x: 3, y: 4, text: '' });
});

describe('for the selected block it opens', () => {
  it('for a child, or beside the block if it has no room for a child', () => {
    select('r');
    openQuickAddHere('child', 'x');
    expect(goal()).toEqual({ does: 'add', place: { at: 'child', parent: 'r', index: 2 } });
    expect(now.editor().quickAdd).toMatchObject({ tree: 'Main', x: 200, y: 200, text: 'x' });
    select('i');
    openQuickAddHere('child');
    expect(goal()).toEqual({ does: 'add', place: { at: 'child', parent: 'r', index: 1 } });
    expect(now.editor().quickAdd?.text).toBe('');
  });

  it('after it', () => {
    select('i');
    openQuickAddHere('after');
    expect(goal()).toEqual({ does: 'add', place: { at: 'child', parent: 'r', index: 1 } });
  });

  it('around all selected blocks', () => {
    select('i', 'a');
    openQuickAddHere('wrap');
    expect(goal()).toEqual({ does: 'wrap', nodes: ['i', 'a'] });
  });

  it('for another type', () => {
    select('a', 'i');
    openQuickAddHere('morph');
    expect(goal()).toEqual({ does: 'morph', node: 'a' });
  });

  it('at the block', () => {
    draw('node-a', new DOMRect(30, 40, 140, 44));
    select('a');
    openQuickAddHere('after');
    expect(now.editor().quickAdd).toMatchObject({ x: 30, y: 92 });
  });
});

describe('without a selection it opens', () => {
  it('for nothing, if it would wrap or change a block', () => {
    openQuickAddHere('wrap');
    openQuickAddHere('morph');
    expect(goal()).toBeUndefined();
  });

  it.each(['child', 'after'] as const)('for the end of the tree: %s', (what) => {
    openQuickAddHere(what);
    expect(goal()).toEqual({ does: 'add', place: { at: 'child', parent: 'r', index: 2 } });
  });
});

it('does not open without a tree', () => {
  useProjectStore.getState().setActiveTree(null);
  openQuickAddHere('child');
  openQuickAddBelow('Main', 'r', 1, 1);
  expect(now.editor().quickAdd).toBeNull();
});
