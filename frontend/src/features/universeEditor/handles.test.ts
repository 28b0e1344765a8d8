import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { select, type Mode } from '@/features/editor3d/editing';
import { setThingPose } from '@/features/editor3d/scene/Gizmo';
import { HALL, openUniverse } from '../../../harness/documents';
import { fakeServer } from '../../../harness/testing';
import { readingOf } from './editor';
import { handlesOf } from './handles';
import { EditorTextures } from './textures';
import { UniverseScene } from './UniverseScene';

function begin(text = HALL) {
  fakeServer({});
  const editor = openUniverse(text);
  const scene = new UniverseScene(true, () => undefined, new EditorTextures(() => undefined, 1));
  const handles = handlesOf(editor, scene);
  handles.show();
  const thing = (id: string) => readingOf(editor).universe!.things.find((each) => each.id === id);
  /** Performs a gesture of the gizmo: from its place to the one that `change` sets. */
  const gesture = (mode: Mode, change: (pivot: THREE.Object3D) => void) => {
    const pivot = new THREE.Object3D();
    setThingPose(pivot, handles.stand()!.pose);
    pivot.updateMatrixWorld(true);
    const start = pivot.matrixWorld.clone();
    change(pivot);
    handles.commit(mode, pivot, start);
  };
  return { editor, scene, handles, thing, gesture };
}

describe('the place of the gizmo', () => {
  it('is null without a selection, and while walls are drawn', () => {
    const { editor, handles } = begin();
    expect(handles.stand()).toBeNull();
    select(editor, ['crate']);
    expect(handles.stand()).not.toBeNull();
    editor.store.setState({ tool: 'wall' });
    expect(handles.stand()).toBeNull();
  });

  it('is at the thing, with its allowed operations', () => {
    const { editor, handles } = begin();
    select(editor, ['crate']);
    editor.store.setState({ mode: 'size', grid: 0.5 });
    expect(handles.stand()).toEqual({
      pose: [1, 2, 0.2, 0, 0, 0],
      mode: 'size',
      turnsFreely: true,
      isFlat: false,
      grid: 0.5,
    });
  });

  it.each(['urdf', 'sdf'])('only moves a model of a %s instead of stretching it', (shape) => {
    const { editor, handles } = begin(
      HALL.replace('shape: box, size: [0.4, 0.4, 0.4]', `shape: ${shape}, file: a.${shape}`),
    );
    select(editor, ['crate']);
    editor.store.setState({ mode: 'size' });
    expect(handles.stand()?.mode).toBe('move');
  });

  it('only moves robots and people, even in the mode that stretches', () => {
    const { editor, handles } = begin();
    editor.store.setState({ mode: 'size' });
    select(editor, ['robot']);
    expect(handles.stand()).toMatchObject({
      mode: 'move',
      turnsFreely: false,
      isFlat: false,
      pose: [3, 3, 0, 0, 0, 0],
    });
    select(editor, ['walker']);
    expect(handles.stand()).toMatchObject({ mode: 'move', isFlat: true, pose: [0, 0, 0, 0, 0, 0] });
  });

  it('is at the selected waypoint, which can only be moved', () => {
    const { editor, handles } = begin();
    select(editor, ['walker'], 2);
    editor.store.setState({ mode: 'turn' });
    expect(handles.stand()).toMatchObject({ mode: 'move', pose: [2, 2, 0, 0, 0, 0], isFlat: true });
    select(editor, ['walker']);
    expect(handles.stand()).toMatchObject({ mode: 'turn', pose: [0, 0, 0, 0, 0, 0] });
  });

  it('is in the middle of several things, which turn about the vertical axis', () => {
    const { editor, handles } = begin();
    select(editor, ['crate', 'robot']);
    expect(handles.stand()).toMatchObject({ pose: [2, 2.5, 0, 0, 0, 0], turnsFreely: false, isFlat: false });
    select(editor, ['crate', 'walker']);
    expect(handles.stand()).toMatchObject({ isFlat: true });
  });
});

describe('the objects that follow the gizmo', () => {
  it('are the selection, or the handle of the selected waypoint', () => {
    const { editor, scene, handles } = begin();
    select(editor, ['crate', 'ball']);
    expect(handles.held()).toEqual([scene.nodeOf('crate'), scene.nodeOf('ball')]);
    select(editor, ['walker'], 1);
    const [handle] = handles.held();
    expect(handle?.userData['waypoint']).toBe(1);
    select(editor, ['gone']);
    expect(handles.held()).toEqual([]);
  });
});

describe('a gesture', () => {
  it('places one thing at the gizmo', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['crate']);
    gesture('move', (pivot) => pivot.position.set(4, 5, 1));
    expect(thing('crate')).toMatchObject({ pose: [4, 5, 1, 0, 0, 0] });
    gesture('turn', (pivot) => pivot.rotateZ(0.5));
    expect(thing('crate')).toMatchObject({ pose: [4, 5, 1, 0, 0, 0.5] });
    expect(editor.store.getState().undoStack.past.map(({ label }) => label)).toEqual(['move', 'turn']);
  });

  it('stretches by steps of the grid, and keeps a thing on the floor', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['crate']);
    gesture('size', (pivot) => pivot.scale.set(1, 1, 2.6));
    expect(thing('crate')).toMatchObject({ size: [0.4, 0.4, 1], pose: [1, 2, 0.5, 0, 0, 0] });
  });

  it('stretches an area about its middle, and moves one corner of it', () => {
    const { editor, gesture, thing } = begin(`${HALL}areas:\n  door: {box: [1, 2, 3, 4]}\n`);
    select(editor, ['door']);
    gesture('size', (pivot) => pivot.scale.set(2, 1, 3));
    expect(readingOf(editor).universe!.raw['areas']).toEqual({ door: { box: [0, 2, 4, 4] } });
    select(editor, ['door'], 2);
    gesture('move', (pivot) => pivot.position.set(5, 6, 0));
    expect(readingOf(editor).universe!.raw['areas']).toEqual({ door: { box: [0, 2, 5, 6] } });
    select(editor, ['door']);
    gesture('turn', (pivot) => pivot.rotateZ(1));
    expect(thing('door')).toMatchObject({ shape: 'polygon' });
  });

  it('moves a robot even in the mode that stretches', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['robot']);
    gesture('size', (pivot) => pivot.position.set(1, 0, 0));
    expect(thing('robot')).toMatchObject({ pose: [1, 0, 0, 0, 0, 0] });
  });

  it('moves only the selected waypoint', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['walker'], 1);
    gesture('move', (pivot) => pivot.position.set(5, 1, 0));
    expect(thing('walker')).toMatchObject({
      path: [
        [0, 0],
        [5, 1],
        [2, 2],
      ],
    });
  });

  it('moves a whole path, and turns it about its start', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['walker']);
    gesture('move', (pivot) => pivot.position.set(1, 2, 0));
    expect(thing('walker')).toMatchObject({ path: [expect.anything(), [3, 2], [3, 4]] });
    gesture('turn', (pivot) => pivot.rotateZ(Math.PI / 2));
    expect(thing('walker')).toMatchObject({
      path: [
        [1, 2],
        [1, 4],
        [-1, 4],
      ],
    });
  });

  it('moves and turns several things together', () => {
    const { editor, gesture, thing } = begin();
    select(editor, ['crate', 'robot']);
    gesture('move', (pivot) => pivot.position.add(new THREE.Vector3(1, -1, 0.5)));
    expect(thing('crate')).toMatchObject({ pose: [2, 1, 0.7, 0, 0, 0] });
    expect(thing('robot')).toMatchObject({ pose: [4, 2, 0.5, 0, 0, 0] });
    gesture('turn', (pivot) => pivot.rotateZ(Math.PI));
    expect(thing('crate')).toMatchObject({ pose: [4, 2, 0.7, 0, 0, 3.1416] });
    expect(thing('robot')).toMatchObject({ pose: [2, 1, 0.5, 0, 0, 3.1416] });
  });
});
