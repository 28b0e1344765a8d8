import { describe, expect, it } from 'vitest';
import { select, travel } from '@/features/editor3d/editing';
import { openRobot } from '../../../harness/documents';
import { duplicateSelected, nudge, placePart, removeSelected, turnSelected } from './commands';
import { readingOf, type RobotEditor } from './editor';

const robot = (editor: RobotEditor) => readingOf(editor).robot!;
const part = (editor: RobotEditor, key: string) => robot(editor).parts.find((each) => each.key === key);
const pose = (editor: RobotEditor, key: string) =>
  part(editor, key)!.pose.map((value) => Math.round(value * 1e4) / 1e4 + 0);
const selected = (editor: RobotEditor) => editor.store.getState().selection;
const looksAlong = (forward: readonly [number, number]) => ({
  center: () => [0, 0] as const,
  forward: () => forward,
  cancel: () => false,
});

describe('placePart', () => {
  it('puts a part where it is dropped, on the grid, and selects it', () => {
    const editor = openRobot();
    placePart(editor, { kind: 'box' }, [0.1013, -0.0487]);
    const [key] = selected(editor);
    expect(part(editor, key!)).toMatchObject({ kind: 'link', name: 'part_link' });
    expect(pose(editor, key!).slice(0, 2)).toEqual([0.1, -0.05]);
  });

  it('puts it at the usual place of its kind otherwise', () => {
    const editor = openRobot();
    placePart(editor, { kind: 'imu' });
    expect(part(editor, selected(editor)[0]!)).toMatchObject({ kind: 'imu', name: 'imu' });
    placePart(editor, { kind: 'battery' });
    expect(part(editor, selected(editor)[0]!)).toMatchObject({ kind: 'battery', link: null });
  });
});

describe('placePart with a mesh', () => {
  it('adds a piece of body that looks like it', () => {
    const editor = openRobot();
    placePart(editor, { mesh: { file: 'meshes/arm.stl', scale: 0.001 } });
    const { name } = part(editor, selected(editor)[0]!)!;
    expect(robot(editor).urdf.links.get(name)?.visuals).toMatchObject([
      { shape: 'mesh', file: 'meshes/arm.stl', size: [0.001, 0.001, 0.001] },
    ]);
  });
});

describe('the selected parts of a robot', () => {
  it('are removed, except for the base', () => {
    const editor = openRobot();
    select(editor, ['sensor scan', 'link base_link']);
    removeSelected(editor);
    expect(part(editor, 'sensor scan')).toBeUndefined();
    expect(part(editor, 'link base_link')).toBeDefined();
  });

  it('are copied five centimetres beside themselves', () => {
    const editor = openRobot();
    select(editor, ['sensor camera']);
    duplicateSelected(editor);
    expect(selected(editor)).toEqual(['sensor camera_2']);
    expect(pose(editor, 'sensor camera_2')).toEqual([0.162, 0.05, 0.11, 0, 0, 0]);
  });

  it('move by steps of the grid along the axes of the view; one undo reverts all steps', () => {
    const editor = openRobot();
    select(editor, ['sensor camera']);
    const start = pose(editor, 'sensor camera');
    expect(start.slice(0, 3)).toEqual([0.162, 0, 0.11]);
    nudge(editor, 1, 0, 0);
    nudge(editor, 0, 1, 0);
    expect(pose(editor, 'sensor camera').slice(0, 3)).toEqual([0.167, 0.005, 0.11]);
    editor.view = looksAlong([0, 1]);
    nudge(editor, 1, 0, 2, 5);
    expect(pose(editor, 'sensor camera').slice(0, 3)).toEqual([0.167, 0.03, 0.16]);
    nudge(editor, 0, 1, 0);
    expect(pose(editor, 'sensor camera').slice(0, 3)).toEqual([0.162, 0.03, 0.16]);
    travel(editor, 'undo');
    expect(pose(editor, 'sensor camera')).toEqual(start);
  });

  it('move by a millimetre without a grid', () => {
    const editor = openRobot();
    editor.store.setState({ grid: 0 });
    select(editor, ['sensor camera']);
    nudge(editor, 1, 0, 0);
    expect(pose(editor, 'sensor camera')[0]).toBe(0.163);
  });

  it('turn about their own vertical axes', () => {
    const editor = openRobot();
    select(editor, ['sensor camera']);
    turnSelected(editor, Math.PI / 2);
    turnSelected(editor, Math.PI / 2);
    expect(pose(editor, 'sensor camera')).toEqual([0.162, 0, 0.11, 0, 0, 3.1416]);
    travel(editor, 'undo');
    expect(pose(editor, 'sensor camera')[5]).toBe(0);
    expect(editor.store.getState().undoStack.future.map(({ label }) => label)).toEqual(['turn']);
  });
});
