import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { closeNewRobot, openNewRobot, useNewRobot } from '@/store/dialogs/newRobot';
import { useProjectStore } from '@/store/project';
import { write } from '../../../harness/documents';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { NewRobot } from './NewRobot';

const ROBOTS = [{ id: 'own_rover', name: 'Own rover', description: 'Six wheels.' }];

function dialog(base?: string) {
  const navigation = watchNavigation();
  fakeServer({
    'GET /catalog/robots': ROBOTS,
    'GET /catalog/robots/own_rover/config': new Response('name: R\nurdf: rover.urdf\n'),
    'GET /catalog/robots/own_rover/urdf': new Response('<robot name="rover"/>'),
  });
  openProject({ texts: { 'robots/Mine/robot.yaml': '' } });
  show(<NewRobot />);
  act(() => openNewRobot(base));
  return navigation;
}

const name = () => screen.findByTestId<HTMLInputElement>('new-robot-name');

beforeEach(() => closeNewRobot());

describe('the dialogue for a new robot', () => {
  it('offers the template first, then the built-in robots', async () => {
    dialog();
    expect(await name()).toHaveValue('my_robot');
    expect(screen.getByRole('radio', { name: /Two wheels/ })).toBeChecked();
    expect(screen.getByRole('radio', { name: /Own rover/ })).not.toBeChecked();
    expect(screen.getByText(/A base, two driven wheels/)).toBeInTheDocument();
  });

  it('makes a robot from the template, runs with it, and opens it', async () => {
    const { openFile } = dialog();
    await user.type(await name(), '{Enter}');
    await waitFor(() => expect(openFile).toHaveBeenCalledWith('robots/my_robot/robot.yaml', undefined));
    const project = useProjectStore.getState();
    expect(project.currentText('robots/my_robot/robot.urdf')).toBe(robotUrdf);
    expect(project.currentText('robots/my_robot/robot.yaml')).toMatch(/name: "?My robot"?/);
    expect(project.settings?.robot).toBe('my_robot');
    expect(useNewRobot.getState().base).toBeNull();
  });

  it('copies a built-in robot with its URDF, and only copies it if it is not to be used', async () => {
    const { openFile } = dialog('own_rover');
    expect(await name()).toHaveValue('my_own_rover');
    await user.click(screen.getByRole('switch', { name: 'Run this project with it' }));
    await user.click(screen.getByTestId('new-robot-ok'));
    await waitFor(() => expect(openFile).toHaveBeenCalledWith('robots/my_own_rover/robot.yaml', undefined));
    const project = useProjectStore.getState();
    expect(project.currentText('robots/my_own_rover/rover.urdf')).toBe('<robot name="rover"/>');
    expect(project.settings?.robot).toBeUndefined();
  });

  it('refuses the name of another robot', async () => {
    dialog();
    await write(await name(), 'mine');
    expect(screen.getByText('This project already has a robot with this name')).toBeInTheDocument();
    expect(screen.getByTestId('new-robot-ok')).toBeDisabled();
  });
});
