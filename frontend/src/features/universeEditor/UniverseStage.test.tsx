import { act, fireEvent } from '@testing-library/react';
import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { HALL, openUniverse } from '../../../harness/documents';
import { objectsOf, pixelOf, showScene } from '../../../harness/scene';
import { fakeServer } from '../../../harness/testing';
import { readingOf } from './editor';
import { UniverseStage } from './UniverseStage';

function stage(text = HALL) {
  fakeServer({});
  const editor = openUniverse(text);
  const universe = () => readingOf(editor).universe!;
  const element = () => <UniverseStage editor={editor} universe={universe()} isDark={false} />;
  const shown = showScene(element());
  const thing = (id: string) => universe().things.find((each) => each.id === id);
  const at = (x: number, y: number, z = 0) => ({
    button: 0,
    pointerId: 1,
    ...pixelOf(shown.camera, x, y, z),
  });
  const click = (x: number, y: number, z = 0) => {
    fireEvent.pointerDown(shown.canvas, at(x, y, z));
    fireEvent.pointerUp(shown.canvas, at(x, y, z));
  };
  return { ...shown, editor, thing, at, click, update: () => shown.rerender(element()) };
}

describe('the stage of a universe', () => {
  it('draws its things, its lights and its ground', () => {
    const { scene } = stage();
    const [sun] = objectsOf(scene, THREE.DirectionalLight);
    expect(sun!.intensity).toBe(2);
    expect(
      sun!.position
        .clone()
        .normalize()
        .toArray()
        .map((part) => Math.round(part * 100) / 100),
    ).toEqual(
      new THREE.Vector3(0.4, -0.3, 1)
        .normalize()
        .toArray()
        .map((part) => Math.round(part * 100) / 100),
    );
    const keys: unknown[] = [];
    scene.traverse(({ userData }) => userData['thing'] && keys.push(userData['thing']));
    expect(keys).toEqual(['crate', 'ball', 'carpet', 'walker', 'robot']);
  });

  it('selects by a click, and drags over the floor by steps of the grid', () => {
    const { editor, thing, at, click, canvas } = stage();
    click(1, 2, 0.4);
    expect(editor.store.getState().selection).toEqual(['crate']);
    act(() => select(editor, []));
    fireEvent.pointerDown(canvas, at(1, 2, 0.4));
    fireEvent.pointerMove(canvas, { ...at(1.52, 2.48, 0.4), buttons: 1 });
    fireEvent.pointerUp(canvas, at(1.52, 2.48, 0.4));
    expect(thing('crate')).toMatchObject({ pose: [1.5, 2.5, 0.2, 0, 0, 0] });
  });

  it('draws walls between clicks, on the grid', () => {
    const { editor, thing, at, click, canvas } = stage();
    act(() => editor.store.setState({ tool: 'wall' }));
    click(-1.02, -1.01);
    fireEvent.pointerMove(canvas, at(-3, -1));
    click(-3.01, -0.98);
    expect(thing('wall')).toMatchObject({ pose: [-2, -1, 0.5, 0, 0, 3.1416], size: [2.15, 0.15, 1] });
    act(() => editor.store.setState({ tool: 'select' }));
    act(() => editor.store.setState({ tool: 'wall' }));
    click(0, 0);
    expect(thing('wall_2')).toBeUndefined();
  });

  it('draws the document again after a change', () => {
    const { editor, scene, thing, update } = stage();
    act(() => select(editor, ['crate']));
    const node = () => {
      let found: THREE.Object3D | undefined;
      scene.traverse((object) => {
        if (object.userData['thing'] === 'crate') found = object;
      });
      return found!;
    };
    expect(node().position.x).toBe(1);
    act(() => editor.view?.cancel());
    const before = thing('crate');
    expect(before).toMatchObject({ pose: [1, 2, 0.2, 0, 0, 0] });
    update();
    expect(node().children.find(({ userData }) => userData['isMark'])?.visible).toBe(true);
  });
});
