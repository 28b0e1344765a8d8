import { describe, expect, it } from 'vitest';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { TEMPLATE } from '@/store/dialogs/newRobot';
import { fakeServer } from '../../../harness/testing';
import { textsOfRobot } from './textsOfRobot';

describe('textsOfRobot', () => {
  it('are those of the template, named after its folder', async () => {
    const { requests } = fakeServer({});
    const texts = await textsOfRobot(TEMPLATE, 'my_first_robot');
    expect(texts.yaml).toMatch(/^name: "?My first robot"?$/m);
    expect(texts.yaml).toContain('format: bt-studio/robot');
    expect(texts).toMatchObject({ urdf: robotUrdf, urdfName: 'robot.urdf' });
    expect(requests).toEqual([]);
  });

  it('are those of a built-in robot, under the name of its URDF', async () => {
    fakeServer({
      'GET /catalog/robots/rover/config': new Response('name: Rover\nurdf: rover.urdf\n'),
      'GET /catalog/robots/rover/urdf': new Response('<robot name="rover"/>'),
    });
    expect(await textsOfRobot('rover', 'x')).toEqual({
      yaml: 'name: X\nurdf: rover.urdf\n',
      urdf: '<robot name="rover"/>',
      urdfName: 'rover.urdf',
    });
  });

  it('name the URDF if the robot does not', async () => {
    fakeServer({
      'GET /catalog/robots/rover/config': new Response('name: Rover\n'),
      'GET /catalog/robots/rover/urdf': new Response('<robot/>'),
    });
    expect((await textsOfRobot('rover', 'x')).urdfName).toBe('robot.urdf');
  });
});
