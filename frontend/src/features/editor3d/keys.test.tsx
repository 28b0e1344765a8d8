import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openUniverse, UNIVERSE } from '../../../harness/documents';
import { show } from '../../../harness/testing';
import { change, select, showIn, type Editor } from './editing';
import { onEditorKey, onPanelKey, type KeyActs } from './keys';

let editor: Editor;
const own = vi.fn();
const acts = {
  modes: ['move', 'turn'],
  nudge: vi.fn(),
  turn: vi.fn(),
  remove: vi.fn(),
  duplicate: vi.fn(),
  all: () => ['a', 'b'],
  others: { w: own },
} satisfies KeyActs;
const above = vi.fn();

const text = () => useProjectStore.getState().currentText(UNIVERSE);
const state = () => editor.store.getState();

beforeEach(() => {
  editor = openUniverse('a: 1\n');
  vi.clearAllMocks();
});

describe('the keys of a view', () => {
  /** Presses a key; returns whether the editor handled it. */
  const press = (key: string, more: object = {}) =>
    !fireEvent.keyDown(screen.getByTestId('view'), { key, ...more });

  beforeEach(() => {
    show(
      <div onKeyDown={above} role="presentation">
        <div role="presentation" data-testid="view" onKeyDown={(event) => onEditorKey(editor, event, acts)} />
      </div>,
    );
  });

  it.each([
    ['ArrowUp', [1, 0, 0, 1]],
    ['ArrowDown', [-1, 0, 0, 1]],
    ['ArrowLeft', [0, 1, 0, 1]],
    ['ArrowRight', [0, -1, 0, 1]],
    ['PageUp', [0, 0, 1, 1]],
    ['PageDown', [0, 0, -1, 1]],
  ])('%s moves a step, with Shift five', (key, [along, aside, up, factor]) => {
    expect(press(key)).toBe(true);
    expect(acts.nudge).toHaveBeenLastCalledWith(along, aside, up, factor);
    expect(press(key, { shiftKey: true })).toBe(true);
    expect(acts.nudge).toHaveBeenLastCalledWith(along, aside, up, 5);
    expect(above).not.toHaveBeenCalled();
  });

  it('turn to both sides, and remove', () => {
    press('q');
    press('E', { shiftKey: true });
    expect(acts.turn.mock.calls).toEqual([[1], [-1]]);
    press('Delete');
    press('Backspace');
    expect(acts.remove).toHaveBeenCalledTimes(2);
  });

  it('choose what dragging does, as far as the editor can', () => {
    expect(press('r')).toBe(true);
    expect(state().mode).toBe('turn');
    expect(press('M')).toBe(true);
    expect(state().mode).toBe('move');
    expect(press('s')).toBe(false);
    expect(state().mode).toBe('move');
    expect(above).toHaveBeenCalledOnce();
  });

  it.each([
    ['f', 'selection'],
    ['t', 'top'],
    ['p', 'default'],
  ])('%s moves the camera: %s', (key, kind) => {
    const before = state().viewpoint;
    press(key);
    expect(state().viewpoint).toEqual({ kind });
    expect(state().viewpoint).not.toBe(before);
  });

  it('Escape ends one thing at a time', () => {
    const cancel = vi.fn(() => true);
    showIn(editor, { center: () => [0, 0], forward: () => [1, 0], cancel });
    select(editor, ['a']);
    editor.store.setState({ tool: 'wall' });
    press('Escape');
    expect(state()).toMatchObject({ tool: 'wall', selection: ['a'] });
    cancel.mockReturnValue(false);
    press('Escape');
    expect(state()).toMatchObject({ tool: 'select', selection: ['a'] });
    press('Escape');
    expect(state()).toMatchObject({ tool: 'select', selection: [] });
  });

  it('place the thing whose ghost is shown, and move the ghost', () => {
    const placer = { aim: vi.fn(), shift: vi.fn(), put: vi.fn(), focus: vi.fn() };
    showIn(editor, { center: () => [0, 0], forward: () => [0, 1], cancel: () => false }, placer);
    press('Enter');
    expect(placer.put).not.toHaveBeenCalled();
    editor.store.setState({ grid: 0.5, placing: { name: 'Box', what: {} } });
    press('ArrowUp');
    press('ArrowLeft', { shiftKey: true });
    const steps = placer.shift.mock.calls.map(([by]: number[][]) => by!.map((part) => part + 0));
    expect(steps).toEqual([
      [0, 0.5],
      [-2.5, 0],
    ]);
    expect(acts.nudge).not.toHaveBeenCalled();
    press('Enter');
    press('Enter', { shiftKey: true });
    expect(placer.put.mock.calls).toEqual([[false], [true]]);
  });

  it('copy, select all, undo and redo with Control', () => {
    change(editor, 'one', () => ({ texts: ['a: 2\n'] }));
    press('d', { ctrlKey: true });
    expect(acts.duplicate).toHaveBeenCalledOnce();
    press('a', { metaKey: true });
    expect(state().selection).toEqual(['a', 'b']);
    press('z', { ctrlKey: true });
    expect(text()).toBe('a: 1\n');
    press('Z', { ctrlKey: true, shiftKey: true });
    expect(text()).toBe('a: 2\n');
    press('z', { ctrlKey: true });
    press('y', { ctrlKey: true });
    expect(text()).toBe('a: 2\n');
  });

  it('include those of the editor', () => {
    press('w');
    expect(own).toHaveBeenCalledExactlyOnceWith(editor, expect.objectContaining({ key: 'w' }));
  });

  it('leave all other keys to the page', () => {
    expect(press('x')).toBe(false);
    expect(press('q', { altKey: true })).toBe(false);
    expect(press('w', { ctrlKey: true })).toBe(false);
    expect(press('Delete', { ctrlKey: true })).toBe(false);
    expect(acts.turn).not.toHaveBeenCalled();
    expect(own).not.toHaveBeenCalled();
    expect(above).toHaveBeenCalledTimes(4);
  });
});

describe('the keys of a panel', () => {
  const press = (testId: string, key: string, more: object = {}) =>
    !fireEvent.keyDown(screen.getByTestId(testId), { key, ...more });

  beforeEach(() => {
    show(
      <div role="presentation" onKeyDown={(event) => onPanelKey(editor, event)}>
        <button data-testid="button" />
        <input data-testid="input" />
        <textarea data-testid="area" />
      </div>,
    );
    change(editor, 'one', () => ({ texts: ['a: 2\n'] }));
  });

  it('undo and redo', () => {
    expect(press('button', 'z', { ctrlKey: true })).toBe(true);
    expect(text()).toBe('a: 1\n');
    expect(press('button', 'Z', { metaKey: true, shiftKey: true })).toBe(true);
    expect(text()).toBe('a: 2\n');
    press('button', 'z', { ctrlKey: true });
    expect(press('button', 'y', { ctrlKey: true })).toBe(true);
    expect(text()).toBe('a: 2\n');
  });

  it('leave typing to its field, and other keys to the page', () => {
    expect(press('input', 'z', { ctrlKey: true })).toBe(false);
    expect(press('area', 'z', { ctrlKey: true })).toBe(false);
    expect(press('button', 'z')).toBe(false);
    expect(press('button', 'z', { ctrlKey: true, altKey: true })).toBe(false);
    expect(press('button', 'd', { ctrlKey: true })).toBe(false);
    expect(text()).toBe('a: 2\n');
  });
});
