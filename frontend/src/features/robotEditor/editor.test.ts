import { describe, expect, it } from 'vitest';
import { select, travel } from '@/features/editor3d/editing';
import { setValue } from '@/model/robot/edits';
import { useProjectStore } from '@/store/project';
import { lookOnly, openRobot, ROBOT, URDF } from '../../../harness/documents';
import { edit, editorOf, GRIDS, readingOf, urdfPathOf } from './editor';

const text = (path: string) => useProjectStore.getState().currentText(path);

describe('urdfPathOf', () => {
  it.each([
    ['urdf: robot.urdf', 'robots/mine/robot.urdf'],
    ['urdf: urdf/Robot.URDF', 'robots/mine/urdf/Robot.URDF'],
    ['urdf: robot.xacro', null],
    ['urdf: /robot.urdf', null],
    ['urdf: ../other/robot.urdf', null],
    ['urdf: a/../../robot.urdf', null],
    ['name: nothing', null],
    ['', null],
  ])('of %s is %s', (yaml, path) => {
    expect(urdfPathOf(ROBOT, yaml)).toBe(path);
  });
});

describe('the editor of a robot', () => {
  it('is the same for a path, and begins with a grid that the toolbar offers', () => {
    const editor = openRobot();
    expect(editorOf(ROBOT)).toBe(editor);
    expect(editor.store.getState().grid).toBe(0.005);
    expect(GRIDS).toContain(0.005);
  });

  it('reads both texts', () => {
    const editor = openRobot();
    expect(readingOf(editor).robot?.parts.map(({ key }) => key)).toEqual([
      'link base_link',
      'link wheel_left_link',
      'link wheel_right_link',
      'link caster_link',
      'sensor scan',
      'sensor camera',
    ]);
    useProjectStore.getState().deleteFile(URDF);
    expect(readingOf(editor)).toMatchObject({ robot: null, problems: [{ kind: 'noUrdf' }] });
  });

  it('changes either text, in one step each', () => {
    const editor = openRobot();
    edit(editor, 'name', (robot) => setValue(robot, ['name'], 'Rover'));
    expect(text(ROBOT)).toContain('name: Rover');
    edit(editor, 'body', (robot) => ({ ops: [], urdf: `${robot.urdfText}\n` }));
    expect(text(URDF)?.endsWith('\n\n')).toBe(true);
    expect(editor.store.getState().undoStack.past.map(({ label }) => label)).toEqual(['name', 'body']);
    edit(editor, 'nothing', () => ({ ops: [] }));
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
  });

  it('joins edits of one key', () => {
    const editor = openRobot();
    for (const [name, key] of [
      ['a', 'x'],
      ['b', 'x'],
      ['c', 'y'],
    ] as const)
      edit(editor, 'name', (robot) => setValue(robot, ['name'], name), key);
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
  });

  it('selects after undo what still exists', () => {
    const editor = openRobot();
    select(editor, ['sensor scan', 'sensor gone']);
    edit(editor, 'name', (robot) => ({ ...setValue(robot, ['name'], 'a'), select: ['sensor camera'] }));
    expect(editor.store.getState().selection).toEqual(['sensor camera']);
    travel(editor, 'undo');
    expect(editor.store.getState().selection).toEqual(['sensor scan']);
  });

  it('leaves unreadable texts, and those of a read-only project, unchanged', () => {
    const broken = openRobot({ [ROBOT]: 'a: [' });
    edit(broken, 'name', (robot) => setValue(robot, ['name'], 'a'));
    expect(text(ROBOT)).toBe('a: [');
    const editor = openRobot();
    const before = text(ROBOT);
    lookOnly();
    edit(editor, 'name', (robot) => setValue(robot, ['name'], 'a'));
    expect(text(ROBOT)).toBe(before);
  });
});
