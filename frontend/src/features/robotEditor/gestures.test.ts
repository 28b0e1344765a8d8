import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { select, type Mode } from '@/features/editor3d/editing';
import { setThingPose } from '@/features/editor3d/scene/Gizmo';
import { openRobot, ROBOT } from '../../../harness/documents';
import { readingOf } from './editor';
import { dragHandlerOf, handlesOf } from './gestures';
import { RobotScene } from './RobotScene';

function begin(texts: Readonly<Record<string, string>> = {}) {
  const editor = openRobot(texts);
  const scene = new RobotScene(true, () => undefined, 'robots/mine/');
  const handles = handlesOf(editor, scene);
  handles.show();
  const pose = (key: string) =>
    readingOf(editor)
      .robot!.parts.find((each) => each.key === key)!
      .pose.map((value) => Math.round(value * 1e4) / 1e4 + 0);
  const gesture = (mode: Mode, change: (pivot: THREE.Object3D) => void) => {
    const pivot = new THREE.Object3D();
    setThingPose(pivot, handles.stand()!.pose);
    pivot.updateMatrixWorld(true);
    const start = pivot.matrixWorld.clone();
    change(pivot);
    handles.commit(mode, pivot, start);
  };
  return { editor, scene, handles, drag: dragHandlerOf(editor, scene), pose, gesture };
}

const on = (key: string) => ({ key, height: 0, waypoint: null });

describe('the gizmo on a robot', () => {
  it('is at the part, and turns it about all axes', () => {
    const { editor, handles } = begin();
    expect(handles.stand()).toBeNull();
    select(editor, ['sensor camera']);
    editor.store.setState({ mode: 'turn', grid: 0.01 });
    expect(handles.stand()).toEqual({
      pose: [0.162, 0, 0.11, 0, 0, 0].map((part) => expect.closeTo(part, 9) as number),
      mode: 'turn',
      turnsFreely: true,
      isFlat: false,
      grid: 0.01,
    });
  });

  it('only moves several parts, and never stretches one', () => {
    const { editor, handles } = begin();
    select(editor, ['sensor camera', 'sensor scan']);
    editor.store.setState({ mode: 'turn' });
    expect(handles.stand()?.mode).toBe('move');
    select(editor, ['sensor camera']);
    editor.store.setState({ mode: 'size' });
    expect(handles.stand()?.mode).toBe('move');
  });

  it('does not move the base', () => {
    const { editor, handles } = begin();
    select(editor, ['link base_link']);
    expect(handles.stand()).toBeNull();
    expect(handles.held()).toEqual([]);
  });

  it('moves the parts that are attached to another', () => {
    const { editor, scene, handles } = begin();
    select(editor, ['link caster_link', 'link base_link']);
    expect(handles.held()).toEqual([scene.nodeOf('link caster_link')]);
  });

  it('places one part', () => {
    const { editor, pose, gesture } = begin();
    select(editor, ['sensor camera']);
    gesture('move', (pivot) => pivot.position.set(0.2, 0.1, 0.3));
    gesture('turn', (pivot) => pivot.rotateZ(0.5));
    expect(pose('sensor camera')).toEqual([0.2, 0.1, 0.3, 0, 0, 0.5]);
    expect(editor.store.getState().undoStack.past.map(({ label }) => label)).toEqual(['move', 'turn']);
  });

  it('moves several parts by the same offset', () => {
    const { editor, pose, gesture } = begin();
    select(editor, ['link base_link', 'sensor camera', 'sensor scan']);
    gesture('move', (pivot) => pivot.position.add(new THREE.Vector3(0.1, -0.05, 0.02)));
    expect(pose('sensor camera')).toEqual([0.262, -0.05, 0.13, 0, 0, 0]);
    expect(pose('sensor scan')).toEqual([0.1, -0.05, 0.19, 0, 0, 0]);
    expect(pose('link base_link')).toEqual([0, 0, 0, 0, 0, 0]);
  });

  it('has nothing to write without a selection, or a robot', () => {
    const { editor, handles } = begin();
    handles.commit('move', new THREE.Object3D(), new THREE.Matrix4());
    expect(editor.store.getState().undoStack.past).toEqual([]);
    const broken = begin({ [ROBOT]: 'a: [' });
    select(broken.editor, ['sensor camera']);
    expect(broken.handles.stand()).toBeNull();
    expect(broken.drag.take(on('sensor camera'))).toBeNull();
  });
});

describe('dragging parts', () => {
  it('takes a part, or the selection that it belongs to; the base stays', () => {
    const { editor, scene, drag } = begin();
    expect(drag.take(on('sensor camera'))).toEqual({
      keys: ['sensor camera'],
      anchor: [0.162, 0],
      nodes: [scene.nodeOf('sensor camera')],
    });
    select(editor, ['sensor scan', 'sensor camera']);
    expect(drag.take(on('sensor camera'))?.keys).toEqual(['sensor scan', 'sensor camera']);
    expect(drag.take(on('link base_link'))).toBeNull();
    expect(drag.take(on('gone'))).toBeNull();
  });

  it('drops it at its height, and selects it', () => {
    const { editor, drag, pose } = begin();
    drag.drop(['sensor camera'], [-0.062, 0.02]);
    expect(pose('sensor camera')).toEqual([0.1, 0.02, 0.11, 0, 0, 0]);
    expect(editor.store.getState().selection).toEqual(['sensor camera']);
    select(editor, ['sensor camera', 'sensor scan']);
    drag.drop(['sensor camera'], [0.01, 0]);
    expect(editor.store.getState().selection).toEqual(['sensor camera', 'sensor scan']);
  });

  it('selects by clicks: one, one more, one less, none', () => {
    const { editor, drag } = begin();
    const selection = () => editor.store.getState().selection;
    drag.click(on('sensor camera'), false);
    drag.click(on('sensor scan'), true);
    expect(selection()).toEqual(['sensor camera', 'sensor scan']);
    drag.click(on('sensor camera'), true);
    expect(selection()).toEqual(['sensor scan']);
    drag.click(on('link base_link'), false);
    expect(selection()).toEqual(['link base_link']);
    drag.click(null, false);
    expect(selection()).toEqual([]);
  });
});
