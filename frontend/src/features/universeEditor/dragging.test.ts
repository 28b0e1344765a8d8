import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { openUniverse } from '../../../harness/documents';
import { fakeServer } from '../../../harness/testing';
import { dragHandlerOf, wallDrawing } from './dragging';
import { readingOf } from './editor';
import { EditorTextures } from './textures';
import { UniverseScene } from './UniverseScene';
import { WallLine } from './WallLine';

function begin() {
  fakeServer({});
  const editor = openUniverse();
  const scene = new UniverseScene(true, () => undefined, new EditorTextures(() => undefined, 1));
  scene.showUniverse(readingOf(editor).universe!);
  const thing = (id: string) => readingOf(editor).universe!.things.find((each) => each.id === id);
  return { editor, scene, thing, drag: dragHandlerOf(editor, scene) };
}

const on = (key: string, waypoint: number | null = null) => ({ key, height: 0, waypoint });

describe('dragging things', () => {
  it('takes the thing under the pointer', () => {
    const { scene, drag } = begin();
    expect(drag.take(on('crate'))).toEqual({
      keys: ['crate'],
      anchor: [1, 2],
      nodes: [scene.nodeOf('crate')],
    });
    expect(drag.take(on('walker'))?.anchor).toEqual([0, 0]);
  });

  it('takes the whole selection with one of its things', () => {
    const { editor, scene, drag } = begin();
    select(editor, ['ball', 'crate']);
    expect(drag.take(on('crate'))).toEqual({
      keys: ['ball', 'crate'],
      anchor: [1, 2],
      nodes: [scene.nodeOf('ball'), scene.nodeOf('crate')],
    });
    expect(drag.take(on('robot'))?.keys).toEqual(['robot']);
  });

  it('ignores floors until they are selected, waypoints, and missing things', () => {
    const { editor, drag } = begin();
    expect(drag.take(on('carpet'))).toBeNull();
    select(editor, ['carpet']);
    expect(drag.take(on('carpet'))?.keys).toEqual(['carpet']);
    expect(drag.take(on('walker', 1))).toBeNull();
    expect(drag.take(on('nothing'))).toBeNull();
  });

  it('moves things over the floor, and selects what was dragged', () => {
    const { editor, drag, thing } = begin();
    drag.drop(['crate'], [0.5, -1]);
    expect(thing('crate')).toMatchObject({ pose: [1.5, 1, 0.2, 0, 0, 0] });
    expect(editor.store.getState().selection).toEqual(['crate']);
  });

  it('keeps the selection and its waypoint if all of it was dragged', () => {
    const { editor, drag } = begin();
    select(editor, ['walker', 'crate'], 1);
    drag.drop(['crate'], [1, 0]);
    expect(editor.store.getState()).toMatchObject({ selection: ['walker', 'crate'], waypoint: 1 });
  });

  it('selects by clicks: one, one more, one less, none', () => {
    const { editor, drag } = begin();
    const state = () => editor.store.getState();
    drag.click(on('walker', 2), false);
    expect(state()).toMatchObject({ selection: ['walker'], waypoint: 2 });
    drag.click(on('crate'), true);
    expect(state()).toMatchObject({ selection: ['walker', 'crate'], waypoint: null });
    drag.click(on('walker'), true);
    expect(state().selection).toEqual(['crate']);
    drag.click(null, false);
    expect(state().selection).toEqual([]);
  });
});

describe('drawing walls', () => {
  it('is on while its tool is chosen', () => {
    const { editor } = begin();
    const drawing = wallDrawing(editor, new WallLine());
    expect(drawing.isOn()).toBe(false);
    editor.store.setState({ tool: 'wall' });
    expect(drawing.isOn()).toBe(true);
  });

  it('builds a wall from each click to the next, and shows the one to come', () => {
    const { editor, thing } = begin();
    const line = new WallLine();
    const drawing = wallDrawing(editor, line);
    drawing.click([0, 0], false);
    expect(thing('wall')).toBeUndefined();
    drawing.move([2, 0]);
    expect(line.group.visible).toBe(true);
    expect(line.group.children[0]?.visible).toBe(true);
    drawing.click([2, 0], false);
    drawing.click([2, 3], false);
    expect(thing('wall')).toMatchObject({ pose: [1, 0, 0.5, 0, 0, 0] });
    expect(thing('wall_2')).toMatchObject({ pose: [2, 1.5, 0.5, 0, 0, 1.5708] });
  });

  it('ends the row of walls, and returns whether there was one', () => {
    const { editor, thing } = begin();
    const line = new WallLine();
    const drawing = wallDrawing(editor, line);
    expect(drawing.end()).toBe(false);
    drawing.click([0, 0], false);
    drawing.move([1, 0]);
    expect(drawing.end()).toBe(true);
    expect(line.group.visible).toBe(false);
    drawing.click([5, 5], false);
    expect(thing('wall')).toBeUndefined();
    drawing.click(null, false);
    drawing.click([6, 6], false);
    expect(thing('wall')).toBeUndefined();
  });
});
