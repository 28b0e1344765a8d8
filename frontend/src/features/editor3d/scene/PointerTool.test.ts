import { fireEvent } from '@testing-library/react';
import * as THREE from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { lookOnly, openUniverse } from '../../../../harness/documents';
import { cameraAbove, pixelOf, testCanvas } from '../../../../harness/scene';
import { PointerTool, type DragHandler } from './PointerTool';

const isOn = vi.fn(() => false);
const isTaken = vi.fn(() => false);
const end = vi.fn(() => false);

/**
 * Returns the tool for a scene with a plate of 1 m at (2, 0), 1 m above the floor, and a neighbour that is
 * dragged with it.
 */
function begin() {
  const canvas = testCanvas();
  canvas.tabIndex = 0;
  const camera = cameraAbove();
  const editor = openUniverse();
  const plate = new THREE.Mesh(new THREE.PlaneGeometry(1, 1));
  plate.position.set(2, 0, 1);
  const other = new THREE.Object3D();
  other.position.set(-2, 1, 0);
  const group = new THREE.Group().add(plate);
  group.updateMatrixWorld(true);
  const dragHandler = {
    take: vi.fn<DragHandler['take']>(() => ({
      keys: ['plate', 'other'],
      anchor: [2, 0],
      nodes: [plate, other],
    })),
    drop: vi.fn<DragHandler['drop']>(),
    click: vi.fn<DragHandler['click']>(),
  };
  const drawing = { isOn, height: () => 0, move: vi.fn(), click: vi.fn(), end };
  const on = { hold: vi.fn(), redraw: vi.fn() };
  const scene = { group, keyOf: (part: THREE.Object3D) => (part === plate ? 'plate' : null) };
  const tool = new PointerTool({
    editor,
    scene,
    dragHandler,
    drawings: [drawing],
    camera,
    canvas,
    isTaken,
    ...on,
  });
  const at = (x: number, y: number, more: object = {}) => ({
    button: 0,
    pointerId: 1,
    ...pixelOf(camera, x, y, 1),
    ...more,
  });
  const down = (x: number, y: number, more = {}) => fireEvent.pointerDown(canvas, at(x, y, more));
  const move = (x: number, y: number, more = {}) =>
    fireEvent.pointerMove(canvas, at(x, y, { buttons: 1, ...more }));
  const up = (x: number, y: number, more = {}) => fireEvent.pointerUp(canvas, at(x, y, more));
  return { canvas, editor, plate, other, dragHandler, drawing, ...on, tool, down, move, up };
}

beforeEach(() => {
  isOn.mockReset().mockReturnValue(false);
  isTaken.mockReset().mockReturnValue(false);
  end.mockReset().mockReturnValue(false);
});

describe('dragging', () => {
  it('moves things at the height at which they were grabbed, on the grid, and drops them', () => {
    const { canvas, plate, other, dragHandler, hold, redraw, down, move, up } = begin();
    const capture = vi.spyOn(canvas, 'setPointerCapture');
    down(2.2, 0.1);
    expect(dragHandler.take).toHaveBeenCalledExactlyOnceWith({
      key: 'plate',
      height: expect.closeTo(1) as number,
      waypoint: null,
    });
    expect(hold).toHaveBeenLastCalledWith(true);
    expect(capture).toHaveBeenCalledExactlyOnceWith(1);
    expect(canvas).toHaveFocus();
    move(3.23, 0.57);
    expect(canvas.style.cursor).toBe('grabbing');
    expect(plate.position.toArray()).toEqual([3, 0.5, 1]);
    expect(other.position.toArray()).toEqual([-1, 1.5, 0]);
    expect(redraw).toHaveBeenCalledOnce();
    expect(dragHandler.drop).not.toHaveBeenCalled();
    up(3.23, 0.57);
    expect(dragHandler.drop).toHaveBeenCalledExactlyOnceWith(['plate', 'other'], [1, 0.5]);
    expect(dragHandler.click).not.toHaveBeenCalled();
    expect(hold).toHaveBeenLastCalledWith(false);
    expect(canvas.style.cursor).toBe('');
  });

  it('takes the thing under the pointer, even under an arm of the gizmo', () => {
    const { editor, dragHandler, down, up } = begin();
    isTaken.mockReturnValue(true);
    editor.store.setState({ selection: ['plate'] });
    down(2, 0);
    expect(dragHandler.take).not.toHaveBeenCalled();
    editor.store.setState({ selection: [] });
    down(2, 0);
    up(2, 0);
    expect(dragHandler.click).toHaveBeenCalledOnce();
    dragHandler.take.mockReturnValue(null);
    down(2, 0);
    up(2, 0);
    expect(dragHandler.click).toHaveBeenCalledOnce();
  });

  it('is cancelled by the right button', () => {
    const { plate, dragHandler, down, move, up } = begin();
    down(2, 0);
    move(3, 0);
    fireEvent.mouseDown(window, { button: 2 });
    move(3, 0.2);
    expect(plate.position.toArray()).toEqual([2, 0, 1]);
    up(3, 0.2);
    expect(dragHandler.drop).not.toHaveBeenCalled();
    expect(dragHandler.click).not.toHaveBeenCalled();
  });

  it.each([
    ['Escape', () => fireEvent.keyDown(window, { key: 'Escape' })],
    ['a window that loses the focus', () => fireEvent.blur(window)],
  ])('is cancelled by %s', (_, give) => {
    const { plate, canvas, dragHandler, hold, down, move, up } = begin();
    down(2, 0);
    move(3, 0);
    give();
    expect(plate.position.toArray()).toEqual([2, 0, 1]);
    expect(canvas.style.cursor).toBe('');
    expect(hold).toHaveBeenLastCalledWith(false);
    up(3, 0);
    expect(dragHandler.drop).not.toHaveBeenCalled();
  });

  it('puts the thing under the pointer on the grid, wherever it stood', () => {
    const { dragHandler, plate, down, move } = begin();
    dragHandler.take.mockReturnValue({ keys: ['plate'], anchor: [2.03, 0.04], nodes: [plate] });
    down(2, 0);
    move(3, 0);
    expect(plate.position.x).toBeCloseTo(2 + 0.97);
    expect(plate.position.y).toBeCloseTo(-0.04);
  });

  it('is a click as long as the pointer stays near, but not after it was away', () => {
    const { canvas, plate, dragHandler, down, move } = begin();
    const press = { button: 0, pointerId: 1, clientX: 230, clientY: 150 };
    fireEvent.pointerDown(canvas, press);
    fireEvent.pointerMove(canvas, { ...press, clientX: 233.9, buttons: 1 });
    expect(plate.position.x).toBe(2);
    fireEvent.pointerUp(canvas, { ...press, clientX: 233.9 });
    expect(dragHandler.click).toHaveBeenCalledOnce();
    expect(dragHandler.drop).not.toHaveBeenCalled();
    down(2, 0);
    move(3, 0);
    move(2, 0);
    fireEvent.pointerUp(canvas, { ...press });
    expect(dragHandler.drop).toHaveBeenCalledExactlyOnceWith(['plate', 'other'], [0, 0]);
    expect(dragHandler.click).toHaveBeenCalledOnce();
  });

  it('is cancelled: everything returns', () => {
    const { plate, other, dragHandler, hold, tool, down, move, up } = begin();
    expect(tool.cancel()).toBe(false);
    down(2, 0);
    move(4, 1);
    expect(tool.cancel()).toBe(true);
    expect(plate.position.toArray()).toEqual([2, 0, 1]);
    expect(other.position.toArray()).toEqual([-2, 1, 0]);
    expect(hold).toHaveBeenLastCalledWith(false);
    up(4, 1);
    expect(dragHandler.drop).not.toHaveBeenCalled();
    expect(dragHandler.click).not.toHaveBeenCalled();
  });

  it('is cancelled by the system too', () => {
    const { canvas, plate, down, move } = begin();
    down(2, 0);
    move(4, 1);
    fireEvent.pointerCancel(canvas, { pointerId: 1 });
    expect(plate.position.toArray()).toEqual([2, 0, 1]);
  });

  it.each([
    ['the other button', (): object => ({ button: 2 })],
    ['the gizmo', (): object => (isTaken.mockReturnValue(true), {})],
    ['a selection that grows', (): object => ({ shiftKey: true })],
    ['a project that may only be seen', (): object => (lookOnly(), {})],
  ])('does not begin with %s', (_, prepare) => {
    const { editor, dragHandler, down } = begin();
    editor.store.setState({ selection: ['plate'] });
    down(2, 0, prepare());
    expect(dragHandler.take).not.toHaveBeenCalled();
  });

  it('leaves things that cannot be dragged, and the floor, to the view', () => {
    const { canvas, dragHandler, hold, down, move, up } = begin();
    const later = vi.fn();
    canvas.addEventListener('pointerdown', later);
    dragHandler.take.mockReturnValue(null);
    down(2, 0);
    down(-3, -3);
    expect(later).toHaveBeenCalledTimes(2);
    move(4, 0);
    up(4, 0);
    expect(hold).not.toHaveBeenCalled();
    expect(dragHandler.click).not.toHaveBeenCalled();
    expect(dragHandler.drop).not.toHaveBeenCalled();
  });

  it('keeps the press that starts it from the view', () => {
    const { canvas, down } = begin();
    const later = vi.fn();
    canvas.addEventListener('pointerdown', later);
    down(2, 0);
    expect(later).not.toHaveBeenCalled();
  });
});

describe('clicking', () => {
  it.each([
    [{}, false],
    [{ shiftKey: true }, true],
    [{ ctrlKey: true }, true],
    [{ metaKey: true }, true],
  ])('selects with %o', (keys, isAdding) => {
    const { dragHandler, down, up } = begin();
    down(2, 0, keys);
    up(2, 0, keys);
    expect(dragHandler.click).toHaveBeenCalledExactlyOnceWith(
      expect.objectContaining({ key: 'plate' }),
      isAdding,
    );
  });

  it('selects nothing on the floor', () => {
    const { dragHandler, down, up } = begin();
    down(-3, -3);
    up(-3, -3);
    expect(dragHandler.click).toHaveBeenCalledExactlyOnceWith(null, false);
  });

  it('does nothing without a press, or with another button', () => {
    const { dragHandler, down, up } = begin();
    up(2, 0);
    down(2, 0);
    up(2, 0, { button: 2 });
    expect(dragHandler.click).not.toHaveBeenCalled();
  });

  it('shows the pointer over things that can be clicked', () => {
    const { canvas, move } = begin();
    move(2, 0, { buttons: 0 });
    expect(canvas.style.cursor).toBe('pointer');
    move(-3, 0, { buttons: 1 });
    expect(canvas.style.cursor).toBe('pointer');
    move(-3, 0, { buttons: 0 });
    expect(canvas.style.cursor).toBe('');
  });
});

describe('drawing', () => {
  it('adds points of the floor on the grid, instead of selecting', () => {
    isOn.mockReturnValue(true);
    const { canvas, dragHandler, drawing, redraw, editor } = begin();
    const pixel = { button: 0, pointerId: 1, ...pixelOf(cameraAbove(), 1.23, -0.98) };
    fireEvent.pointerMove(canvas, pixel);
    expect(drawing.move).toHaveBeenCalledExactlyOnceWith([1.2, -1]);
    expect(redraw).toHaveBeenCalledOnce();
    fireEvent.pointerDown(canvas, pixel);
    fireEvent.pointerUp(canvas, pixel);
    expect(drawing.click).toHaveBeenCalledExactlyOnceWith([1.2, -1], false);
    expect(redraw).toHaveBeenCalledTimes(2);
    expect(dragHandler.take).not.toHaveBeenCalled();
    expect(dragHandler.click).not.toHaveBeenCalled();
    editor.store.setState({ grid: 0 });
    fireEvent.pointerMove(canvas, pixel);
    expect(drawing.move).toHaveBeenLastCalledWith([1.23, -0.98]);
  });

  it('is ended by the right button, which moves the view otherwise', () => {
    isOn.mockReturnValue(true);
    const { canvas, drawing, down } = begin();
    const later = vi.fn();
    canvas.addEventListener('pointerdown', later);
    end.mockReturnValueOnce(true);
    down(2, 0, { button: 2 });
    expect(drawing.end).toHaveBeenCalledOnce();
    expect(later).not.toHaveBeenCalled();
    down(2, 0, { button: 2 });
    expect(later).toHaveBeenCalledOnce();
  });

  it('is ended with the gesture', () => {
    const { tool, redraw } = begin();
    end.mockReturnValue(true);
    expect(tool.cancel()).toBe(true);
    expect(redraw).toHaveBeenCalledOnce();
  });

  it('stops with the tool', () => {
    const { tool, dragHandler, down, up } = begin();
    tool.dispose();
    down(2, 0);
    up(2, 0);
    expect(dragHandler.take).not.toHaveBeenCalled();
    expect(dragHandler.click).not.toHaveBeenCalled();
  });
});
