import { fireEvent } from '@testing-library/react';
import fc from 'fast-check';
import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Pose } from '@/model/document/values';
import { cameraAbove, pixelOf, testCanvas } from '../../../../harness/scene';
import { Gizmo, poseOf, setThingPose, type Stand } from './Gizmo';

const STAND: Stand = { pose: [1, 2, 0, 0, 0, 0], mode: 'move', turnsFreely: true, isFlat: false, grid: 0.5 };

function gizmo(first: Partial<Stand> = {}) {
  let stand: Stand | null = { ...STAND, ...first };
  const node = new THREE.Object3D();
  node.position.set(3, 2, 0);
  const handles = { stand: () => stand, held: () => [node], commit: vi.fn(), show: vi.fn() };
  const on = { change: vi.fn(), hold: vi.fn() };
  const camera = cameraAbove();
  const made = new Gizmo(handles, camera, testCanvas(), on);
  new THREE.Scene().add(made.root);
  made.update();
  const pointer = (x: number, y: number, button: number) => {
    const { clientX, clientY } = pixelOf(camera, x, y);
    return { x: clientX / 200 - 1, y: 1 - clientY / 150, button };
  };
  /** Grabs the handle of an axis at one place, and drags it to another. */
  const drag = (axis: string, from: readonly [number, number], to: readonly [number, number]) => {
    const { controls } = made;
    controls.axis = axis as typeof controls.axis;
    made.root.updateMatrixWorld(true);
    controls.pointerDown(pointer(...from, 0) as unknown as PointerEvent);
    made.root.updateMatrixWorld(true);
    controls.pointerMove(pointer(...to, -1) as unknown as PointerEvent);
  };
  const letGo = () => made.controls.pointerUp(null as unknown as PointerEvent);
  const setStand = (next: Stand | null) => {
    stand = next;
    made.update();
  };
  return { gizmo: made, controls: made.controls, handles, on, node, drag, letGo, setStand };
}

describe('poses', () => {
  it('are read as they were set, except straight up and down', () => {
    const metres = fc.double({ min: -50, max: 50, noNaN: true });
    const angle = fc.double({ min: -3, max: 3, noNaN: true });
    const pitch = fc.double({ min: -1.5, max: 1.5, noNaN: true });
    fc.assert(
      fc.property(fc.tuple(metres, metres, metres, angle, pitch, angle), (pose) => {
        const object = new THREE.Object3D();
        object.scale.set(2, 3, 4);
        setThingPose(object, pose as Pose);
        expect(poseOf(object).map((part, at) => Math.abs(part - (pose[at] ?? 0)) < 1e-6)).toEqual(
          Array(6).fill(true),
        );
        expect(object.scale.toArray()).toEqual([1, 1, 1]);
      }),
      { numRuns: 50 },
    );
  });
});

describe('the place of the gizmo', () => {
  it('is at the selection; it is hidden without one', () => {
    const { controls, setStand } = gizmo();
    expect(controls.object?.position.toArray()).toEqual([1, 2, 0]);
    setStand(null);
    expect(controls.object).toBeUndefined();
  });

  it.each([
    ['move', 'translate', 'world'],
    ['turn', 'rotate', 'local'],
    ['size', 'scale', 'local'],
  ] as const)('in the mode %s has the handles for it', (mode, handles, space) => {
    const { controls } = gizmo({ mode });
    expect([controls.getMode(), controls.space]).toEqual([handles, space]);
  });

  it.each([
    [{ mode: 'move' }, [true, true, true]],
    [{ mode: 'move', isFlat: true }, [true, true, false]],
    [{ mode: 'move', turnsFreely: false }, [true, true, true]],
    [{ mode: 'turn' }, [true, true, true]],
    [{ mode: 'turn', turnsFreely: false }, [false, false, true]],
    [{ mode: 'turn', turnsFreely: false, isFlat: true }, [false, false, true]],
    [{ mode: 'size', turnsFreely: false }, [true, true, true]],
  ] as const)('offers the axes that %o allows', (stand, shown) => {
    const { controls } = gizmo(stand);
    expect([controls.showX, controls.showY, controls.showZ]).toEqual(shown);
  });

  it('snaps to the grid and to 15 degrees, unless there is no grid', () => {
    expect(gizmo().controls).toMatchObject({ translationSnap: 0.5, rotationSnap: Math.PI / 12 });
    expect(gizmo({ grid: 0 }).controls).toMatchObject({ translationSnap: null, rotationSnap: null });
  });
});

describe('a gesture of the gizmo', () => {
  it('moves the selection by steps of the grid, and writes it at the end', () => {
    const { gizmo: made, handles, on, node, drag, letGo } = gizmo();
    drag('X', [1, 2], [1.8, 2.6]);
    expect(on.hold).toHaveBeenCalledExactlyOnceWith(true);
    expect(node.position.toArray().map((part) => Math.round(part * 1e6) / 1e6)).toEqual([4, 2, 0]);
    expect(handles.commit).not.toHaveBeenCalled();
    letGo();
    expect(on.hold).toHaveBeenLastCalledWith(false);
    const [mode, pivot, start] = handles.commit.mock.lastCall as [string, THREE.Object3D, THREE.Matrix4];
    expect(mode).toBe('move');
    expect(pivot).toBe(made.root.children[1]);
    expect(new THREE.Vector3().setFromMatrixPosition(start).toArray()).toEqual([1, 2, 0]);
    expect(handles.show).toHaveBeenCalledOnce();
    // The handles are again at the place that the document says.
    expect(pivot.position.toArray()).toEqual([1, 2, 0]);
  });

  it('turns the selection about the gizmo', () => {
    const { node, controls, handles, drag, letGo } = gizmo({ mode: 'turn', grid: 0 });
    drag('Z', [2, 2], [2, 2]);
    controls.object!.rotation.z = Math.PI / 2;
    controls.dispatchEvent({ type: 'objectChange' });
    expect(node.position.toArray().map((part) => Math.round(part * 1e6) / 1e6 + 0)).toEqual([1, 4, 0]);
    letGo();
    expect(handles.commit.mock.lastCall?.[0]).toBe('turn');
  });

  it('is cancelled: things return, and nothing is written', () => {
    const { gizmo: made, controls, handles, drag } = gizmo();
    expect(made.cancel()).toBe(false);
    expect(handles.show).not.toHaveBeenCalled();
    drag('X', [1, 2], [3, 2]);
    expect(made.cancel()).toBe(true);
    expect(controls.object?.position.toArray()).toEqual([1, 2, 0]);
    expect(controls.dragging).toBe(false);
    expect(handles.commit).not.toHaveBeenCalled();
    expect(handles.show).toHaveBeenCalledOnce();
  });

  it.each([
    ['Escape', () => fireEvent.keyDown(window, { key: 'Escape' })],
    ['the right button', () => fireEvent.mouseDown(window, { button: 2 })],
    ['a window that loses the focus', () => fireEvent.blur(window)],
  ])('is cancelled by %s, and by nothing after its end', (_, give) => {
    const { gizmo: made, controls, handles, drag, letGo } = gizmo();
    drag('X', [1, 2], [3, 2]);
    give();
    expect(controls.dragging).toBe(false);
    expect(controls.object?.position.toArray()).toEqual([1, 2, 0]);
    expect(handles.commit).not.toHaveBeenCalled();
    drag('X', [1, 2], [3, 2]);
    letGo();
    expect(handles.commit).toHaveBeenCalledOnce();
    const cancel = vi.spyOn(made, 'cancel');
    give();
    expect(cancel).not.toHaveBeenCalled();
  });

  it('asks for another picture whenever it changes', () => {
    const { on, controls } = gizmo();
    on.change.mockClear();
    controls.axis = 'X' as typeof controls.axis;
    expect(on.change).toHaveBeenCalled();
  });

  it('is removed from the scene at its end', () => {
    const { gizmo: made, controls } = gizmo();
    made.dispose();
    expect(made.root.parent).toBeNull();
    expect(controls.object).toBeUndefined();
  });
});
