import { expect, it } from 'vitest';
import { freeName, takenRobots, takenUniverses } from './freeNames';

it('names a copy so that it meets no other', () => {
  const taken = takenUniverses(['universes/My_Maze.yaml', 'universes/my_maze_2.yaml', 'a.md']);
  expect(freeName('my_maze', taken)).toBe('my_maze_3');
  expect(freeName('hall', taken)).toBe('hall');
  expect(freeName('none', taken)).toBe('none_2');
  expect(freeName('my_rover', takenRobots(['robots/MY_rover/robot.yaml', 'robots/x/y.urdf']))).toBe(
    'my_rover_2',
  );
});
