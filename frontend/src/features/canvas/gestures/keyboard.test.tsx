import { createEvent, fireEvent, render, screen } from '@testing-library/react';
import type { KeyboardEvent } from 'react';
import { createPortal } from 'react-dom';
import { beforeEach, describe, expect, it } from 'vitest';
import { childrenOf, emptyDiagram, type Diagram } from '@/model/diagram';
import { setCollapsed, setLayout } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { now, openDiagram } from '../../../../harness/canvas';
import { action, nodeOf, watchNavigation } from '../../../../harness/testing';
import { enterInside, isMenuKey, neighbour, onCanvasKey } from './keyboard';

const nodes: Diagram['nodes'] = {
  r: { type: 'Sequence', children: ['a', 'f', 'g'] },
  a: { type: 'Grasp' },
  f: { type: 'Fallback', children: ['x', 'y'] },
  x: { type: 'Sleep' },
  y: { type: 'Sleep' },
  g: { type: 'Fallback', children: ['z', 's'] },
  z: { type: 'Sleep' },
  s: { type: 'SubTree', tree: 'Dock' },
  d: { type: 'Sequence', children: [] },
};
const main: Diagram = { ...emptyDiagram('Main'), root: 'r', nodes, drafts: ['d'] };

describe('neighbour', () => {
  it.each([
    ['x', 'up', 'f'],
    ['r', 'up', null],
    ['f', 'down', 'x'],
    ['x', 'down', null],
    ['a', 'after', 'f'],
    ['f', 'before', 'a'],
    ['a', 'before', null],
    ['g', 'after', 'd'],
    ['r', 'after', 'd'],
    ['d', 'before', 'r'],
    ['d', 'after', null],
    ['y', 'after', 'z'],
    ['z', 'before', 'y'],
    ['x', 'before', 'a'],
    ['s', 'after', 'd'],
  ] as const)('of %s %s is %s', (id, direction, expected) => {
    expect(neighbour(main, id, direction)).toBe(expected);
  });

  it('is never below a folded block', () => {
    const folded = { ...main, nodes: { ...nodes, g: { ...nodes['g']!, collapsed: true } } };
    expect(neighbour(folded, 'g', 'down')).toBeNull();
    expect(neighbour(folded, 'y', 'after')).toBe('g');
  });
});

it.each([
  [{ key: 'ContextMenu', shiftKey: false }, true],
  [{ key: 'F10', shiftKey: true }, true],
  [{ key: 'F10', shiftKey: false }, false],
  [{ key: 'F10', shiftKey: true, ctrlKey: true }, false],
  [{ key: 'F10', shiftKey: true, metaKey: true }, false],
  [{ key: 'F1', shiftKey: true }, false],
])('isMenuKey of %o is %s', (event, expected) => {
  expect(isMenuKey(event as KeyboardEvent)).toBe(expected);
});

function Page() {
  return (
    // eslint-disable-next-line jsx-a11y/no-static-element-interactions
    <div data-testid="canvas" onKeyDown={onCanvasKey}>
      <div data-testid="block" />
      <input data-testid="input" />
      <textarea data-testid="textarea" />
      <select data-testid="select" />
      <div data-testid="editable" contentEditable="true" />
      <button data-testid="button" />
      {createPortal(<div data-testid="elsewhere" />, document.body)}
    </div>
  );
}

/** Presses a key; returns whether the canvas handled it. */
function press(key: string, more: object = {}, at = 'block'): boolean {
  const event = createEvent.keyDown(screen.getByTestId(at), { key, ...more });
  fireEvent(screen.getByTestId(at), event);
  return event.defaultPrevented;
}

const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);

beforeEach(() => {
  openDiagram(main, {
    actions: [action('Grasp')],
    texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') },
  });
  render(<Page />);
});

describe('arrow keys', () => {
  it('walk from block to block, beginning at the root', () => {
    expect(press('ArrowDown')).toBe(true);
    expect(now.selection()).toEqual(['r']);
    for (const [key, id] of [
      ['ArrowDown', 'a'],
      ['ArrowRight', 'f'],
      ['ArrowDown', 'x'],
      ['ArrowRight', 'y'],
      ['ArrowLeft', 'x'],
      ['ArrowUp', 'f'],
    ] as const) {
      press(key);
      expect(now.selection()).toEqual([id]);
    }
    select('r');
    expect(press('ArrowUp')).toBe(true);
    expect(now.selection()).toEqual(['r']);
  });

  it('follow the directions on the screen in a left-right tree', () => {
    useProjectStore.getState().apply('Main', 'orientation', [setLayout('horizontal')]);
    select('r');
    for (const [key, id] of [
      ['ArrowRight', 'a'],
      ['ArrowDown', 'f'],
      ['ArrowUp', 'a'],
      ['ArrowLeft', 'r'],
    ] as const) {
      press(key);
      expect(now.selection()).toEqual([id]);
    }
  });

  it('extend the selection with Shift, the newest block first', () => {
    select('a');
    press('ArrowRight', { shiftKey: true });
    expect(now.selection()).toEqual(['f', 'a']);
    press('ArrowLeft', { shiftKey: true });
    expect(now.selection()).toEqual(['a', 'f']);
  });

  it('move the block with Ctrl', () => {
    select('a');
    press('ArrowRight', { ctrlKey: true });
    expect(childrenOf(now.diagram(), 'r')).toEqual(['f', 'a', 'g']);
    press('ArrowLeft', { metaKey: true });
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'f', 'g']);
    press('ArrowDown', { ctrlKey: true });
    expect(childrenOf(now.diagram(), 'f')).toEqual(['x', 'y', 'a']);
    press('ArrowUp', { ctrlKey: true });
    expect(childrenOf(now.diagram(), 'r')).toEqual(['f', 'a', 'g']);
  });
});

describe('keys on the selection', () => {
  it('Home selects the root, Escape selects nothing', () => {
    select('y');
    expect(press('Home')).toBe(true);
    expect(now.selection()).toEqual(['r']);
    expect(press('Escape')).toBe(true);
    expect(now.selection()).toEqual([]);
    // There is nothing to leave, so the frame handles the key.
    expect(press('Escape')).toBe(false);
  });

  it('Tab opens the quick-add box for a child, Ctrl+Enter for a sibling', () => {
    select('f');
    expect(press('Tab')).toBe(true);
    const place = { at: 'child', parent: 'f', index: 2 };
    expect(now.editor().quickAdd).toMatchObject({ goal: { does: 'add', place }, text: '' });
    expect(press('Tab', { shiftKey: true })).toBe(false);
    for (const held of ['ctrlKey', 'metaKey']) {
      press('Enter', { [held]: true });
      expect(now.editor().quickAdd).toMatchObject({ goal: { place: { parent: 'r', index: 2 } } });
    }
  });

  it("Enter opens the block's document", () => {
    const { openFile, openTree } = watchNavigation();
    select('a');
    expect(press('Enter')).toBe(true);
    expect(openFile).toHaveBeenCalledWith('actions/Grasp.py');
    select('s');
    press('Enter');
    expect(openTree).toHaveBeenCalledWith('Dock');
  });

  it('F2 edits the name, and a slash the comment', () => {
    select('x');
    expect(press('F2')).toBe(true);
    expect(now.editor().editing).toEqual({ node: 'x', field: 'name' });
    expect(press('/')).toBe(true);
    expect(now.editor().editing).toEqual({ node: 'x', field: 'comment' });
  });

  it.each(['Delete', 'Backspace'])('%s removes the block; Shift keeps the children', (key) => {
    select('f');
    expect(press(key, { shiftKey: true })).toBe(true);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'x', 'y', 'g']);
    select('g');
    press(key);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'x', 'y']);
    expect(nodeOf('Main', 'z')).toBeUndefined();
  });

  it('Space folds a block, or expands a subtree', () => {
    select('f');
    expect(press(' ')).toBe(true);
    expect(nodeOf('Main', 'f')?.collapsed).toBe(true);
    press(' ');
    expect(nodeOf('Main', 'f')?.collapsed).toBeUndefined();
    select('s');
    press(' ');
    expect(now.editor().expanded['Main']).toEqual(new Set(['s']));
  });
});

describe('letters', () => {
  it.each(['a', 'Z', '7', '_'])('%s starts the name of a new block', (key) => {
    expect(press(key)).toBe(true);
    expect(now.editor().quickAdd).toMatchObject({ text: key, goal: { does: 'add' } });
  });

  it.each([
    ['a', { ctrlKey: true }],
    ['a', { metaKey: true }],
    ['a', { altKey: true }],
    ['-', {}],
    ['F5', {}],
    ['Tab', {}],
    ['Delete', {}],
    ['ö', {}],
  ])('%s with %o does nothing on the canvas without a selection', (key, held) => {
    expect(press(key, held)).toBe(false);
    expect(now.editor().quickAdd).toBeNull();
  });
});

describe('an empty tree', () => {
  it('gets its first block with Tab', () => {
    select('r', 'd');
    press('Delete');
    expect(now.diagram().root).toBeNull();
    select();
    expect(press('Home')).toBe(false);
    expect(press('ArrowDown')).toBe(true);
    expect(now.selection()).toEqual([]);
    expect(press('Tab', { shiftKey: true })).toBe(false);
    expect(press('Tab')).toBe(true);
    expect(now.editor().quickAdd).toMatchObject({ goal: { does: 'add', place: { at: 'root' } } });
  });
});

describe('keys that are not for the canvas', () => {
  it.each(['input', 'textarea', 'select', 'editable', 'elsewhere'])('are those in %s', (place) => {
    select('x');
    expect(press('Delete', {}, place)).toBe(false);
    expect(nodeOf('Main', 'x')).toBeDefined();
  });

  it('are those that press or leave a button', () => {
    select('x');
    for (const key of ['Enter', ' ', 'Tab']) expect(press(key, {}, 'button')).toBe(false);
    expect(press('Delete', {}, 'button')).toBe(true);
    expect(nodeOf('Main', 'x')).toBeUndefined();
  });

  it('are all while no tree is open', () => {
    useProjectStore.getState().setActiveTree(null);
    expect(press('ArrowDown')).toBe(false);
  });
});

it('stays at a folded block on the way down', () => {
  useProjectStore.getState().apply('Main', 'fold', [setCollapsed('f', true)]);
  select('f');
  press('ArrowDown');
  expect(now.selection()).toEqual(['f']);
});

it('opens the tree of a block inside of an expanded subtree', () => {
  const { openTree } = watchNavigation();
  enterInside({ tree: 'Dock', node: 'n1' });
  expect(openTree).toHaveBeenCalledWith('Dock');
  expect(useProjectStore.getState()).toMatchObject({
    activeTree: 'Dock',
    selection: ['n1'],
    revealed: { tree: 'Dock', node: 'n1' },
  });
});
