import { act, screen } from '@testing-library/react';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { openRobot, ROBOT, URDF } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import { RobotTab } from './RobotTab';

function tab(texts: Record<string, string> = {}) {
  const run = vi.fn();
  onTestFinished(registerCommands([{ id: 'run.run', group: 'run', labelKey: '', run }]));
  onTestFinished(() => useUniverseChoice.setState(useUniverseChoice.getInitialState(), true));
  const editor = openRobot(texts);
  editor.store.setState({ isTextShown: false });
  show(<RobotTab path={ROBOT} />);
  return { editor, run };
}

describe('the tab of a robot', () => {
  it('shows view, panel and tools, and no problem for a valid robot', () => {
    tab();
    expect(screen.getByTestId('robot-editor')).toHaveAttribute('data-path', ROBOT);
    expect(screen.getByTestId('robot-view')).toBeInTheDocument();
    expect(screen.getByRole('listbox', { name: '6 parts' })).toBeInTheDocument();
    expect(screen.queryByRole('heading', { name: /problem/ })).toBeNull();
    expect(screen.getAllByRole('radio').map((radio) => (radio as HTMLInputElement).value)).toEqual([
      'move',
      'turn',
    ]);
  });

  it('records edits of either text as an undo step', () => {
    const { editor } = tab();
    const type = (path: string, from: string, to: string) => {
      act(() => {
        const project = useProjectStore.getState();
        project.setFileText(path, project.currentText(path)!.replace(from, to));
      });
    };
    type(ROBOT, 'name: My robot', 'name: Rover');
    expect(screen.getByTestId('robot-name')).toHaveValue('Rover');
    act(() => editor.store.setState(({ undoStack }) => ({ undoStack: { ...undoStack, sealed: true } })));
    type(URDF, '0.162 0 0.11', '0.2 0 0.11');
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
  });

  it('offers both texts, or the existing one', () => {
    const { editor } = tab();
    act(() => editor.store.setState({ isTextShown: true }));
    expect(screen.getByRole('radio', { name: 'robot.urdf' })).toBeInTheDocument();
    act(() => useProjectStore.getState().deleteFile(URDF));
    expect(screen.queryByRole('radio', { name: 'robot.urdf' })).toBeNull();
    expect(screen.getByRole('alert')).toHaveTextContent('The robot cannot be shown');
    expect(screen.getByRole('heading', { name: '1 problem' })).toBeInTheDocument();
    expect(screen.getByText('There is no file robot.urdf beside robot.yaml')).toBeInTheDocument();
  });

  it('counts the problems of a robot that can be shown', () => {
    tab({
      [ROBOT]: robotYaml.replace('wheel_torque: 1.5', 'wheel_torque: -1').replace('rays: 360', 'rays: 0'),
    });
    expect(screen.getByRole('heading', { name: '2 problems' })).toBeInTheDocument();
    expect(screen.getByTestId('robot-view')).toBeInTheDocument();
  });

  it('shows only the texts if there is no such robot', () => {
    openRobot();
    show(<RobotTab path="robots/gone/robot.yaml" />);
    expect(screen.getByTestId('robot-editor-text')).toBeInTheDocument();
  });

  it("runs this robot once, whatever the project's robot is", async () => {
    const { run } = tab();
    await user.click(screen.getByTestId('run-here'));
    expect(useUniverseChoice.getState().robot).toBe('mine');
    expect(run).toHaveBeenCalledOnce();
    act(() => useProjectStore.getState().setSettings({ robot: 'mine' }));
    await user.click(screen.getByTestId('run-here'));
    expect(useUniverseChoice.getState().robot).toBeNull();
    expect(run).toHaveBeenCalledTimes(2);
  });
});
