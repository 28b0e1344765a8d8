import { describe, expect, it } from 'vitest';
import { EMPTY_STL, openRobot, ROBOT, stl, takesFile } from '../../../harness/documents';
import { fakeServer } from '../../../harness/testing';
import { bringHere, meshesOf, urdfFolder } from './meshes';

const inFolder = () => openRobot({ [ROBOT]: 'urdf: urdf/mine.urdf\n', 'robots/mine/urdf/mine.urdf': '' });

describe('the meshes of a robot', () => {
  it('are in the folder of its URDF', () => {
    expect(urdfFolder(openRobot())).toBe('robots/mine/');
    expect(urdfFolder(inFolder())).toBe('robots/mine/urdf/');
    expect(urdfFolder(openRobot({ [ROBOT]: 'urdf: ../other.urdf\n' }))).toBe('robots/mine/');
  });

  it('are named relative to it, in order', () => {
    const paths = [
      'robots/mine/urdf/meshes/wheel.dae',
      'robots/mine/urdf/arm.STL',
      'robots/mine/urdf/mine.urdf',
      'robots/mine/base.stl',
      'assets/chair.stl',
    ];
    expect(meshesOf(inFolder(), paths)).toEqual(['arm.STL', 'meshes/wheel.dae']);
  });

  it.each([
    [3, 1],
    [3.1, 0.001],
    [200, 0.001],
  ])('of %s units are added with the scale %s', async (width, scale) => {
    const editor = openRobot();
    fakeServer(takesFile('robots/mine/meshes/arm.stl'));
    expect(await bringHere(editor, new File([stl(width)], 'arm.stl'))).toEqual({
      file: 'meshes/arm.stl',
      scale,
    });
  });

  it('are not added if they cannot be read', async () => {
    const editor = openRobot();
    fakeServer({});
    expect(await bringHere(editor, new File([EMPTY_STL], 'arm.stl'))).toBeNull();
  });
});
