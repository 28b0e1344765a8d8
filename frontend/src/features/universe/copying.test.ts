import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject } from '../../../harness/testing';
import { copyRobot, copyUniverse } from './copying';

const text = (path: string) => useProjectStore.getState().currentText(path);

describe('a copy of a built-in document', () => {
  it('of a universe has the title of its file', async () => {
    fakeServer({ 'GET /catalog/universes/maze/text': new Response('name: Maze # ours\nmodels: []\n') });
    openProject({ texts: {} });
    expect(await copyUniverse('maze', 'my_maze')).toBe('universes/my_maze.yaml');
    expect(text('universes/my_maze.yaml')).toBe('name: "My maze" # ours\nmodels: []\n');
  });

  it('of a robot comes with its URDF', async () => {
    fakeServer({
      'GET /catalog/robots/rover/config': new Response('name: Rover\nurdf: rover.urdf\n'),
      'GET /catalog/robots/rover/urdf': new Response('<robot name="rover"/>'),
    });
    openProject({ texts: {} });
    expect(await copyRobot('rover', 'mine')).toBe('robots/mine/robot.yaml');
    expect(text('robots/mine/robot.yaml')).toBe('name: Mine\nurdf: rover.urdf\n');
    expect(text('robots/mine/rover.urdf')).toBe('<robot name="rover"/>');
  });

  it('is not made from a document that does not come', async () => {
    fakeServer({});
    openProject({ texts: {} });
    await expect(copyUniverse('maze', 'my_maze')).rejects.toThrow();
    expect(text('universes/my_maze.yaml')).toBeNull();
  });
});
