import { describe, expect, it } from 'vitest';
import { select, travel } from '@/features/editor3d/editing';
import { HALL, openUniverse } from '../../../harness/documents';
import {
  deleteSelected,
  duplicateSelected,
  extendWay,
  KINDS,
  nudge,
  placeThing,
  placeWall,
  resize,
  turnSelected,
  type Kind,
} from './commands';
import { readingOf, type UniverseEditor } from './editor';

const things = (editor: UniverseEditor) => readingOf(editor).universe!.things;
const thing = (editor: UniverseEditor, id: string) => things(editor).find((each) => each.id === id);
const last = (editor: UniverseEditor, section: string) =>
  things(editor)
    .filter((each) => each.section === section)
    .at(-1);
const view = (center: readonly [number, number], forward: readonly [number, number] = [1, 0]) => ({
  center: () => center,
  forward: () => forward,
  cancel: () => false,
});

describe('placeThing', () => {
  it('ends the wall tool', () => {
    const editor = openUniverse();
    editor.store.setState({ tool: 'wall' });
    placeThing(editor, { kind: 'crate' }, [1, 1]);
    expect(editor.store.getState().tool).toBe('select');
  });

  const looks: Readonly<Record<Exclude<Kind, 'person' | 'area'>, object>> = {
    wall: { shape: 'box', size: [2, 0.15, 1], color: '#e9e4da', pose: [4, 5, 0.5, 0, 0, 0] },
    box: { shape: 'box', size: [0.6, 0.6, 0.6], color: '#3f6fb5', pose: [4, 5, 0.3, 0, 0, 0] },
    cylinder: { shape: 'cylinder', size: [0.3, 0.8], color: '#d9a441', pose: [4, 5, 0.4, 0, 0, 0] },
    sphere: { shape: 'sphere', size: [0.35], color: '#4f9a6b', pose: [4, 5, 0.35, 0, 0, 0] },
    crate: { shape: 'box', size: [0.4, 0.4, 0.4], mass: 2, pose: [4, 5, 0.2, 0, 0, 0] },
    ball: { shape: 'sphere', size: [0.12], mass: 0.4, restitution: 0.6, pose: [4, 5, 0.12, 0, 0, 0] },
    floor: { shape: 'plane', size: [2, 2], solid: false, pose: [4, 5, 0.003, 0, 0, 0] },
  };

  it.each(Object.entries(looks))(
    'puts a %s where it is dropped, on the grid and on the floor',
    (kind, look) => {
      const editor = openUniverse();
      placeThing(editor, { kind: kind as Kind }, [4.03, 4.98]);
      expect(last(editor, 'models')).toMatchObject(look);
      expect(editor.store.getState().selection).toEqual([last(editor, 'models')!.key]);
    },
  );

  it('offers what is tested here', () => {
    expect([...Object.keys(looks), 'person', 'area']).toEqual([...KINDS]);
  });

  it('puts an area around the place, which moves, turns, gets corners and goes', () => {
    const editor = openUniverse();
    placeThing(editor, { kind: 'area' }, [4.03, 4.98]);
    expect(readingOf(editor).universe!.raw['areas']).toEqual({ area: { box: [3, 4, 5, 6] } });
    expect(editor.store.getState().selection).toEqual(['area']);
    nudge(editor, 1, 0, 0);
    expect(thing(editor, 'area')).toMatchObject({
      shape: 'box',
      path: [
        [3.1, 4],
        [5.1, 4],
        [5.1, 6],
        [3.1, 6],
      ],
    });
    extendWay(editor, 'area', 3);
    expect(thing(editor, 'area')).toMatchObject({ shape: 'polygon' });
    expect(editor.store.getState().waypoint).toBe(4);
    deleteSelected(editor);
    expect(thing(editor, 'area')).toMatchObject({ path: { length: 4 } });
    deleteSelected(editor);
    expect(thing(editor, 'area')).toBeUndefined();
  });

  it('gives a person a path, and a robot its model', () => {
    const editor = openUniverse();
    placeThing(editor, { kind: 'person' }, [1, 1]);
    expect(last(editor, 'actors')).toMatchObject({
      id: 'person',
      path: [
        [1, 1],
        [3, 1],
        [3, 3],
      ],
      speed: 0.5,
      loop: true,
      yields: true,
    });
    placeThing(editor, { kind: 'robot', model: 'rover' }, [-1, -2]);
    expect(last(editor, 'robots')).toMatchObject({
      id: 'robot_2',
      model: 'rover',
      pose: [-1, -2, 0, 0, 0, 0],
    });
  });

  it('names a mesh after its file, in valid letters', () => {
    const editor = openUniverse();
    placeThing(editor, { kind: 'file', shape: 'mesh', file: 'assets/my chair.v2.stl' }, [0, 0]);
    expect(last(editor, 'models')).toMatchObject({
      id: 'my_chair_v2',
      shape: 'mesh',
      file: 'assets/my chair.v2.stl',
    });
    placeThing(editor, { kind: 'file', shape: 'urdf', file: '3d.urdf' }, [0, 0]);
    expect(last(editor, 'models')).toMatchObject({ id: '_3d', shape: 'urdf' });
  });

  it('puts it in the middle of the view, or beside existing things', () => {
    const editor = openUniverse();
    editor.view = view([2, 1]);
    placeThing(editor, { kind: 'box' });
    expect(last(editor, 'models')).toMatchObject({ pose: [2, 1, 0.3, 0, 0, 0] });
    placeThing(editor, { kind: 'box' });
    expect(last(editor, 'models')).toMatchObject({ id: 'box_2', pose: [2.8, 1, 0.3, 0, 0, 0] });
    placeThing(editor, { kind: 'box' });
    expect(last(editor, 'models')).toMatchObject({ pose: [3.6, 1, 0.3, 0, 0, 0] });
  });

  it('puts it at the origin without a view', () => {
    const editor = openUniverse(HALL.replace(/models:[^]*actors/, 'models: []\nactors'));
    placeThing(editor, { kind: 'box' });
    expect(last(editor, 'models')).toMatchObject({ pose: [0, 0, 0.3, 0, 0, 0] });
  });
});

describe('placeWall', () => {
  it('closes corners: it is half a thickness longer at each end', () => {
    const editor = openUniverse();
    placeWall(editor, [0, 0], [0, 3]);
    expect(last(editor, 'models')).toMatchObject({
      id: 'wall',
      size: [3.15, 0.15, 1],
      pose: [0, 1.5, 0.5, 0, 0, 1.5708],
      color: '#e9e4da',
      to_ceiling: false,
    });
  });

  it('reaches the ceiling where there is one', () => {
    const editor = openUniverse(`${HALL}ceiling: {height: 3}\n`);
    placeWall(editor, [0, 0], [1, 0]);
    expect(last(editor, 'models')).toMatchObject({ to_ceiling: true });
  });

  it('builds nothing between two clicks at the same place', () => {
    const editor = openUniverse();
    placeWall(editor, [1, 1], [1.005, 1]);
    expect(things(editor)).toHaveLength(5);
  });
});

describe('the selected things', () => {
  it('are duplicated beside themselves, by half a metre or by a wider grid', () => {
    const editor = openUniverse();
    select(editor, ['crate']);
    duplicateSelected(editor);
    expect(thing(editor, 'crate_2')).toMatchObject({ pose: [1.5, 2.5, 0.2, 0, 0, 0] });
    editor.store.setState({ grid: 1 });
    duplicateSelected(editor);
    expect(thing(editor, 'crate_3')).toMatchObject({ pose: [2.5, 3.5, 0.2, 0, 0, 0] });
  });

  it('are deleted; of a person with a selected waypoint, only the waypoint', () => {
    const editor = openUniverse();
    select(editor, ['walker'], 1);
    deleteSelected(editor);
    expect(thing(editor, 'walker')).toMatchObject({
      path: [
        [0, 0],
        [2, 2],
      ],
    });
    expect(editor.store.getState()).toMatchObject({ selection: ['walker'], waypoint: null });
    deleteSelected(editor);
    expect(thing(editor, 'walker')).toBeUndefined();
  });

  it('move by steps of the grid along the axes of the view', () => {
    const editor = openUniverse();
    select(editor, ['crate']);
    nudge(editor, 1, 0, 0);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.1, 2, 0.2, 0, 0, 0] });
    nudge(editor, 0, 1, 0);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.1, 2.1, 0.2, 0, 0, 0] });
    editor.view = view([0, 0], [0, 1]);
    nudge(editor, 1, 0, 0, 5);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.1, 2.6, 0.2, 0, 0, 0] });
    nudge(editor, 0, 1, 2);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1, 2.6, 0.4, 0, 0, 0] });
  });

  it('move by a centimetre without a grid; one undo reverts all steps', () => {
    const editor = openUniverse();
    editor.store.setState({ grid: 0 });
    select(editor, ['crate']);
    nudge(editor, 1, 0, 0);
    nudge(editor, 1, 0, 0);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.02, 2, 0.2, 0, 0, 0] });
    travel(editor, 'undo');
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1, 2, 0.2, 0, 0, 0] });
  });

  it('can be one waypoint, which moves alone', () => {
    const editor = openUniverse();
    select(editor, ['walker'], 1);
    nudge(editor, 1, 1, 0);
    expect(thing(editor, 'walker')).toMatchObject({
      path: [
        [0, 0],
        [2.1, 0.1],
        [2, 2],
      ],
    });
    select(editor, ['walker']);
    nudge(editor, 1, 0, 0);
    expect(thing(editor, 'walker')).toMatchObject({
      path: [
        [0.1, 0],
        [2.2, 0.1],
        [2.1, 2],
      ],
    });
  });

  it('turn about their own middle', () => {
    const editor = openUniverse();
    select(editor, ['crate']);
    turnSelected(editor, Math.PI / 2);
    turnSelected(editor, Math.PI / 4);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1, 2, 0.2, 0, 0, 2.3562] });
    travel(editor, 'undo');
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1, 2, 0.2, 0, 0, 0] });
    select(editor, ['crate', 'robot']);
    turnSelected(editor, Math.PI);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [3, 3, 0.2, 0, 0, 3.1416] });
    expect(thing(editor, 'robot')).toMatchObject({ pose: [1, 2, 0, 0, 0, 3.1416] });
  });
});

describe('resize', () => {
  it('keeps a thing on the floor there', () => {
    const editor = openUniverse();
    resize(editor, 'crate', [0.4, 0.4, 1]);
    expect(thing(editor, 'crate')).toMatchObject({ size: [0.4, 0.4, 1], pose: [1, 2, 0.5, 0, 0, 0] });
    resize(editor, 'ball', [0.3]);
    expect(thing(editor, 'ball')).toMatchObject({ size: [0.3], pose: [-1, 0, 0.3, 0, 0, 0] });
  });

  it.each([
    ['hangs', '[1, 2, 0.7, 0, 0, 0]', 0.7],
    ['rolls', '[1, 2, 0.2, 0.5, 0, 0]', 0.2],
    ['pitches', '[1, 2, 0.2, 0, 0.5, 0]', 0.2],
  ])('leaves the height of a thing that %s', (_, pose, height) => {
    const editor = openUniverse(HALL.replace('[1, 2, 0.2, 0, 0, 0]', pose));
    resize(editor, 'crate', [0.4, 0.4, 1]);
    const crate = thing(editor, 'crate');
    expect(crate).toMatchObject({ size: [0.4, 0.4, 1] });
    expect(crate?.section === 'models' && crate.pose[2]).toBe(height);
  });

  it('changes nothing of a person, and makes no step for the same size', () => {
    const editor = openUniverse();
    resize(editor, 'walker', [1, 1, 1]);
    resize(editor, 'crate', [0.4, 0.4, 0.4]);
    expect(editor.store.getState().undoStack.past).toHaveLength(0);
  });

  it('merges the steps of one gesture', () => {
    const editor = openUniverse();
    resize(editor, 'crate', [0.4, 0.4, 0.6], 'drag');
    resize(editor, 'crate', [0.4, 0.4, 0.8], 'drag');
    expect(editor.store.getState().undoStack.past).toHaveLength(1);
    resize(editor, 'crate', [0.4, 0.4, 0.9]);
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
  });
});

describe('extendWay', () => {
  it('adds a point half way to the next one, and selects it', () => {
    const editor = openUniverse();
    extendWay(editor, 'walker', 0);
    expect(thing(editor, 'walker')).toMatchObject({
      path: [
        [0, 0],
        [1, 0],
        [2, 0],
        [2, 2],
      ],
    });
    expect(editor.store.getState()).toMatchObject({ selection: ['walker'], waypoint: 1 });
  });

  it('closes a loop, and lengthens an open path', () => {
    const editor = openUniverse();
    extendWay(editor, 'walker', 2);
    expect(thing(editor, 'walker')).toMatchObject({ path: [expect.anything(), [2, 0], [2, 2], [1, 1]] });
    const straight = openUniverse(HALL.replace('loop: true', 'loop: false'));
    extendWay(straight, 'walker', 2);
    expect(thing(straight, 'walker')).toMatchObject({ path: [expect.anything(), [2, 0], [2, 2], [3, 2]] });
    const point = openUniverse(HALL.replace('[[0, 0], [2, 0], [2, 2]]', '[[1, 1]]'));
    extendWay(point, 'walker', 0);
    expect(thing(point, 'walker')).toMatchObject({
      path: [
        [1, 1],
        [2, 1],
      ],
    });
  });

  it('changes nothing without a path', () => {
    const editor = openUniverse();
    extendWay(editor, 'crate', 0);
    expect(editor.store.getState().undoStack.past).toHaveLength(0);
  });
});
