import { act, fireEvent } from '@testing-library/react';
import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { lookOnly, openUniverse } from '../../../../harness/documents';
import { objectsOf, pixelOf, showScene } from '../../../../harness/scene';
import type { Shape } from '@/generated/messages';
import { select } from '../editing';
import { EditorStage } from './EditorStage';
import type { Stand } from './Gizmo';
import type { Placement } from './PlacingTool';
import { frameOf } from './marks';
import { ThingScene } from './ThingScene';

const SHAPE: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };

class Boxes extends ThingScene<{ readonly key: string }> {
  protected stateOf(): unknown {
    return '';
  }
  protected fill(node: THREE.Group): void {
    node.add(this.meshOf(SHAPE));
    node.add(frameOf(node));
  }
  protected put(node: THREE.Group, { key }: { readonly key: string }): void {
    node.position.set(key === 'far' ? 8 : 0, 0, 0.5);
  }
}

const STAND: Stand = { pose: [0, 0, 0.5, 0, 0, 0], mode: 'move', turnsFreely: true, isFlat: false, grid: 0 };

function stage(prepare: () => void = () => undefined) {
  const editor = openUniverse();
  prepare();
  const scene = new Boxes(true, () => undefined);
  const handles = {
    stand: vi.fn((): Stand | null => (editor.store.getState().selection.length > 0 ? STAND : null)),
    held: () => [],
    commit: vi.fn(),
    show: vi.fn(() => scene.show([{ key: 'near' }, { key: 'far' }])),
  };
  const dragHandler = { take: vi.fn(() => null), drop: vi.fn(), click: vi.fn() };
  const drawing = {
    isOn: () => false,
    height: () => 0,
    move: vi.fn(),
    click: vi.fn(),
    end: vi.fn(() => false),
  };
  const ghost = new Boxes(true, () => undefined);
  const placement = {
    scene: ghost,
    draw: vi.fn<Placement['draw']>((what) => (what ? { at: [0, 0], height: 0 } : null)),
    place: vi.fn<Placement['place']>(),
  };
  const staged = { scene, handles, dragHandler, placement, drawing };
  const element = (content: object) => (
    <EditorStage
      editor={editor}
      staged={staged}
      content={content}
      isDark={false}
      lights={[]}
      ground={{ color: [1, 1, 1] }}
      reach={[0.4, 80]}
      extent={[2, 40]}
    />
  );
  const first = {};
  const shown = showScene(element(first));
  return {
    ...shown,
    editor,
    things: scene,
    handles,
    dragHandler,
    placement,
    drawing,
    update: () => shown.rerender(element({})),
  };
}

const grids = (scene: THREE.Scene) => objectsOf(scene, THREE.GridHelper);

describe('the stage of an editor', () => {
  it('draws the document, and again when it changes', () => {
    const { handles, scene, things, update } = stage();
    expect(handles.show).toHaveBeenCalledOnce();
    expect(things.group.parent).toBe(scene);
    update();
    expect(handles.show).toHaveBeenCalledTimes(2);
  });

  it('frames the selection, and puts the gizmo there', () => {
    const { editor, things, handles } = stage();
    handles.stand.mockClear();
    act(() => select(editor, ['far']));
    const frames = ['near', 'far'].map((key) => things.nodeOf(key)!.children.at(-1)!.visible);
    expect(frames).toEqual([false, true]);
    expect(handles.stand).toHaveBeenCalled();
  });

  it('registers its view with the editor, and removes it', () => {
    const { editor, camera, rerender } = stage();
    expect(editor.view?.forward()).toEqual([1, 0]);
    const [x, y] = editor.view!.center();
    expect(x).toBeCloseTo(4);
    expect(y).toBeCloseTo(0);
    expect(editor.view?.cancel()).toBe(false);
    expect(camera.position.length()).toBeGreaterThan(1);
    rerender(<group />);
    expect(editor.view).toBeNull();
  });

  it('moves the camera above, and to the selection', () => {
    const { editor, camera } = stage();
    act(() => editor.store.setState({ viewpoint: { kind: 'top' } }));
    expect(Math.hypot(camera.position.x - 4, camera.position.y)).toBeLessThan(0.1);
    act(() => select(editor, ['far']));
    act(() => editor.store.setState({ viewpoint: { kind: 'selection' } }));
    expect(editor.view?.center()).toEqual([expect.closeTo(8), expect.closeTo(0)]);
    // The distance is 1.6 times the visible extent, which is at least the smallest extent.
    const middle = new THREE.Vector3(8, 0, 0.5);
    expect(camera.position.distanceTo(middle)).toBeCloseTo(1.6 * 2);
    act(() => select(editor, []));
    act(() => editor.store.setState({ viewpoint: { kind: 'selection' } }));
    expect(editor.view?.center()[0]).toBeCloseTo(4);
  });

  it('draws the lines of the grid, unless they are too dense', () => {
    const { editor, scene } = stage();
    expect(grids(scene)).toHaveLength(2);
    const spans = () => grids(scene).map((grid) => new THREE.Box3().setFromObject(grid).max.x);
    expect(spans()).toEqual([20, 10]);
    act(() => editor.store.setState({ grid: 0.01 }));
    expect(spans()).toEqual([20, 5]);
    act(() => editor.store.setState({ grid: 0 }));
    expect(grids(scene)).toHaveLength(1);
    act(() => editor.store.setState({ grid: 1 }));
    expect(grids(scene)).toHaveLength(1);
  });

  it('selects by a click, and ends a drawing when its tool is left', () => {
    const { editor, canvas, camera, dragHandler, drawing } = stage();
    const at = { button: 0, pointerId: 1, ...pixelOf(camera, 0, 0, 0.5) };
    fireEvent.pointerDown(canvas, at);
    expect(dragHandler.take).toHaveBeenCalledOnce();
    fireEvent.pointerUp(canvas, at);
    expect(dragHandler.click).toHaveBeenCalledExactlyOnceWith(
      expect.objectContaining({ key: 'near' }),
      false,
    );
    drawing.end.mockClear();
    act(() => editor.store.setState({ tool: 'wall' }));
    expect(drawing.end).not.toHaveBeenCalled();
    act(() => editor.store.setState({ tool: 'select' }));
    expect(drawing.end).toHaveBeenCalledOnce();
  });

  it('places by a click what was chosen', () => {
    const { editor, canvas, camera, placement } = stage();
    act(() => editor.store.setState({ placing: { name: 'Box', what: { kind: 'box' } } }));
    expect(placement.draw).toHaveBeenLastCalledWith({ kind: 'box' });
    const at = { button: 0, pointerId: 1, ...pixelOf(camera, 2, 1) };
    fireEvent.pointerMove(canvas, at);
    const [x, y] = placement.scene.group.position.toArray();
    expect([x, y]).toEqual([2, 1]);
    fireEvent.pointerDown(canvas, at);
    fireEvent.pointerUp(canvas, at);
    expect(placement.place).toHaveBeenCalledExactlyOnceWith({ kind: 'box' }, [2, 1]);
    expect(editor.store.getState().placing).toBeNull();
    expect(placement.draw).toHaveBeenLastCalledWith(null);
  });

  it('asks for a picture when something changed', async () => {
    const { editor, frames } = stage();
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(0));
    const before = frames();
    act(() => select(editor, ['near']));
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(before));
  });

  it('allows no dragging in a read-only project', () => {
    const { canvas, camera, dragHandler } = stage(lookOnly);
    fireEvent.pointerDown(canvas, { button: 0, pointerId: 1, ...pixelOf(camera, 0, 0, 0.5) });
    expect(dragHandler.take).not.toHaveBeenCalled();
  });
});
