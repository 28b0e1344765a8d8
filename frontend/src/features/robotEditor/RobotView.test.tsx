import { act, fireEvent, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { partOf } from '@/model/robot/types';
import { lookOnly, openRobot, showRobot } from '../../../harness/documents';
import { RobotView } from './RobotView';

function view(prepare: () => void = () => undefined) {
  const editor = openRobot();
  prepare();
  const robot = showRobot(editor, (now) => <RobotView editor={editor} robot={now} />);
  const press = (key: string, more = {}) =>
    fireEvent.keyDown(screen.getByTestId('robot-view'), { key, ...more });
  const pose = (key: string) => partOf(robot(), key)!.pose.map((part) => Math.round(part * 1e4) / 1e4 + 0);
  return { editor, robot, press, pose };
}

describe('the view of a robot', () => {
  it('is one control, with a description if there is no WebGL', () => {
    view();
    expect(screen.getByRole('application', { name: /\. The robot in 3D\./ })).toHaveAttribute(
      'data-things',
      '6',
    );
    expect(screen.getByRole('note')).toHaveTextContent('the robot is not shown in 3D');
  });

  it('handles the keys of the editor', () => {
    const { editor, robot, press, pose } = view();
    act(() => select(editor, ['sensor camera']));
    press('ArrowUp', { shiftKey: true });
    expect(pose('sensor camera')[0]).toBe(0.187);
    press('e');
    expect(pose('sensor camera')[5]).toBe(-0.2618);
    press('q');
    press('q');
    expect(pose('sensor camera')[5]).toBe(0.2618);
    press('r');
    expect(editor.store.getState().mode).toBe('turn');
    press('s');
    expect(editor.store.getState().mode).toBe('turn');
    press('d', { ctrlKey: true });
    expect(robot().parts).toHaveLength(7);
    press('Delete');
    expect(robot().parts).toHaveLength(6);
    press('a', { ctrlKey: true });
    expect(editor.store.getState().selection).toHaveLength(6);
  });

  it('announces the selection and its position', () => {
    const { editor } = view();
    const status = screen.getByRole('status');
    expect(status).toBeEmptyDOMElement();
    act(() => select(editor, ['sensor camera']));
    expect(status).toHaveTextContent('camera at x 0.162, y 0, z 0.11');
    act(() => select(editor, ['sensor camera', 'sensor scan']));
    expect(status).toHaveTextContent(/^2 parts are selected\. They move together\.$/);
    act(() => select(editor, ['sensor gone']));
    expect(status).toBeEmptyDOMElement();
  });

  it('has no palette in a read-only project', () => {
    view(lookOnly);
    expect(screen.queryByRole('toolbar', { name: 'Parts to add' })).toBeNull();
  });
});
