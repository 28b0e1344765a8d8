import { fireEvent } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { openUniverse } from '../../../harness/documents';
import { showIn, type Editor } from './editing';
import { choose, dragFrom } from './placing';

const view = { center: () => [0, 0] as const, forward: () => [1, 0] as const, cancel: () => false };
const placer = { aim: vi.fn(() => true), shift: vi.fn(), put: vi.fn(), focus: vi.fn() };
const place = vi.fn();
const choice = { name: 'Box', what: { kind: 'box' }, place };
let editor: Editor;
const placing = () => editor.store.getState().placing?.name ?? null;

beforeEach(() => {
  vi.clearAllMocks();
  editor = openUniverse();
  showIn(editor, view, placer);
});

describe('choosing what to place', () => {
  it('shows its ghost, and hands the keys to the view', () => {
    editor.store.setState({ tool: 'wall' });
    choose(editor, choice);
    expect(editor.store.getState()).toMatchObject({
      placing: { name: 'Box', what: { kind: 'box' } },
      tool: 'select',
    });
    expect(placer.focus).toHaveBeenCalledOnce();
    expect(place).not.toHaveBeenCalled();
  });

  it('gives up what is chosen again, and takes another one instead', () => {
    choose(editor, choice);
    choose(editor, { ...choice, name: 'Ball' });
    expect(placing()).toBe('Ball');
    choose(editor, { ...choice, name: 'Ball' });
    expect(placing()).toBeNull();
  });

  it('places at once where there is no view in 3D', () => {
    choose(editor, choice);
    showIn(editor, null);
    expect(placing()).toBeNull();
    choose(editor, choice);
    expect(place).toHaveBeenCalledOnce();
    expect(placing()).toBeNull();
  });
});

describe('dragging from the palette', () => {
  function press(more: PointerEventInit = {}) {
    const bar = document.createElement('div');
    bar.setAttribute('role', 'toolbar');
    const [button, other] = [document.createElement('button'), document.createElement('button')];
    bar.append(button, other);
    document.body.append(bar);
    onTestFinished(() => bar.remove());
    const event = new PointerEvent('pointerdown', {
      button: 0,
      pointerId: 1,
      clientX: 10,
      clientY: 10,
      ...more,
    });
    dragFrom(button, event, editor, choice);
    return { button, other };
  }
  const at = (clientX: number, more = {}) => ({ pointerId: 1, clientX, clientY: 10, ...more });

  it('lets the ghost follow, and places it where the pointer is released', () => {
    press();
    fireEvent.pointerMove(window, at(13));
    expect(placing()).toBeNull();
    fireEvent.pointerMove(window, at(90));
    expect(placing()).toBe('Box');
    expect(placer.aim).toHaveBeenLastCalledWith(expect.objectContaining({ clientX: 90 }));
    fireEvent.pointerUp(document.body, at(120));
    expect(placer.aim).toHaveBeenLastCalledWith(expect.objectContaining({ clientX: 120 }));
    expect(placer.put).toHaveBeenCalledExactlyOnceWith(false);
  });

  it('is a click without a movement', () => {
    press();
    fireEvent.pointerUp(document.body, at(12));
    expect(placing()).toBeNull();
    expect(placer.put).not.toHaveBeenCalled();
  });

  it('gives up beside the view, on the palette, and on Escape', () => {
    placer.aim.mockReturnValueOnce(true).mockReturnValueOnce(false);
    press();
    fireEvent.pointerMove(window, at(90));
    fireEvent.pointerUp(document.body, at(900));
    expect(placing()).toBeNull();

    const { other } = press();
    fireEvent.pointerMove(window, at(90));
    fireEvent.pointerUp(other, at(10, { clientY: 50 }));
    expect(placing()).toBeNull();

    press();
    fireEvent.pointerMove(window, at(90));
    fireEvent.keyDown(window, { key: 'Escape' });
    fireEvent.pointerUp(document.body, at(90));
    expect(placing()).toBeNull();
    expect(placer.put).not.toHaveBeenCalled();
  });

  it('leaves a release on its own button to the click that follows', () => {
    const { button } = press();
    fireEvent.pointerMove(window, at(90));
    fireEvent.pointerUp(button, at(10));
    expect(placing()).toBe('Box');
    choose(editor, choice);
    expect(placing()).toBeNull();
  });

  it.each([{ button: 2 }, { pointerType: 'touch' }])('does not begin with %o', (more) => {
    press(more);
    fireEvent.pointerMove(window, at(90));
    expect(placing()).toBeNull();
  });
});
