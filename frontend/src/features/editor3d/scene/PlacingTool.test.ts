import * as THREE from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { openUniverse } from '../../../../harness/documents';
import { cameraAbove, pixelOf, testCanvas } from '../../../../harness/scene';
import { PlacingTool, type Placement } from './PlacingTool';

function begin(height = 0) {
  const editor = openUniverse();
  const canvas = testCanvas();
  const camera = cameraAbove();
  const group = new THREE.Group();
  const placement = {
    scene: { group },
    draw: vi.fn<Placement['draw']>((what) => (what ? { at: [1, 1], height } : null)),
    place: vi.fn<Placement['place']>(),
  };
  const redraw = vi.fn();
  const tool = new PlacingTool({ editor, placement, camera, canvas, redraw });
  const start = (what: object = { kind: 'box' }) => {
    editor.store.setState({ placing: { name: 'Box', what } });
    tool.show();
  };
  return { editor, canvas, camera, group, placement, redraw, tool, start };
}

let made: ReturnType<typeof begin>;
const ghost = () => made.group.position.toArray().map((part) => Math.round(part * 1e6) / 1e6);
const placing = () => made.editor.store.getState().placing;

beforeEach(() => {
  made = begin();
});

describe('the ghost', () => {
  it('is first where the thing would stand, and follows the pointer on the grid', () => {
    const { tool, camera, canvas, redraw, start } = made;
    expect(tool.isOn()).toBe(false);
    start();
    expect(tool.isOn()).toBe(true);
    expect(canvas.style.cursor).toBe('crosshair');
    expect(ghost()).toEqual([0, 0, 0]);
    expect(tool.aim(pixelOf(camera, 2.53, -0.48))).toBe(true);
    expect(ghost()).toEqual([1.5, -1.5, 0]);
    expect(redraw).toHaveBeenCalledTimes(2);
    expect(tool.aim({ clientX: 401, clientY: 10 })).toBe(false);
  });

  it('is held at the height of the thing', () => {
    made = begin(2);
    made.start();
    made.tool.aim(pixelOf(made.camera, 3, 2, 2));
    expect(ghost()).toEqual([2, 1, 0]);
  });

  it('is moved by keys', () => {
    made.start();
    made.tool.shift([0.5, 0]);
    made.tool.shift([0, -0.1]);
    expect(ghost()).toEqual([0.5, -0.1, 0]);
    made.tool.put(false);
    expect(made.placement.place).toHaveBeenCalledExactlyOnceWith({ kind: 'box' }, [1.5, 0.9]);
  });

  it('goes when nothing is chosen any more', () => {
    made.start();
    expect(made.tool.end()).toBe(true);
    expect(placing()).toBeNull();
    made.tool.show();
    expect(made.placement.draw).toHaveBeenLastCalledWith(null);
    expect(made.canvas.style.cursor).toBe('');
    expect(made.tool.end()).toBe(false);
  });
});

describe('placing', () => {
  it('is done by a click, once', () => {
    made.start();
    made.tool.click(null, false);
    expect(made.placement.place).not.toHaveBeenCalled();
    made.tool.click([3, 4], false);
    expect(made.placement.place).toHaveBeenCalledExactlyOnceWith({ kind: 'box' }, [3, 4]);
    expect(placing()).toBeNull();
    made.tool.put(false);
    expect(made.placement.place).toHaveBeenCalledOnce();
  });

  it('continues where the pointer is', () => {
    made.start();
    made.tool.click([3, 4], true);
    expect(placing()).not.toBeNull();
    expect(ghost()).toEqual([2, 3, 0]);
    made.tool.click([5, 4], false);
    expect(made.placement.place.mock.calls.map(([, at]) => at)).toEqual([
      [3, 4],
      [5, 4],
    ]);
  });

  it('continues at the next free place where the ghost was not moved', () => {
    made.start();
    const before = placing();
    made.tool.put(true);
    expect(made.placement.place).toHaveBeenCalledExactlyOnceWith({ kind: 'box' }, undefined);
    expect(placing()).toEqual(before);
    expect(placing()).not.toBe(before);
  });

  it('is done at once for a thing without a ghost', () => {
    made.placement.draw.mockReturnValue(null);
    made.start();
    expect(made.placement.place).toHaveBeenCalledOnce();
    expect(placing()).toBeNull();
  });
});

it('gives the keys to the view', () => {
  const view = document.createElement('div');
  view.setAttribute('role', 'application');
  view.tabIndex = 0;
  made.canvas.replaceWith(view);
  view.append(made.canvas);
  made.tool.focus();
  expect(view).toHaveFocus();
  view.remove();
});
