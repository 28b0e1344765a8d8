import { describe, expect, it } from 'vitest';
import { nameProblem, pathFor } from './names';

const taken = {
  paths: ['actions/Turn.py', 'trees/MainTree.json', 'universes/yard.yaml', 'robots/mine/robot.yaml', 'a.md'],
  types: new Set(['Sequence', 'Turn']),
};

it.each([
  ['action', 'Go', 'actions/Go.py'],
  ['tree', 'Main', 'trees/Main.json'],
  ['universe', 'yard', 'universes/yard.yaml'],
  ['robot', 'mine', 'robots/mine/robot.yaml'],
  ['file', 'assets/a.md', 'assets/a.md'],
] as const)('a %s %s is stored at %s', (kind, name, path) => {
  expect(pathFor(kind, name)).toBe(path);
});

describe('nameProblem', () => {
  it.each([
    ['action', 'FollowWall', null],
    ['action', 'turn', 'taken'],
    ['action', 'Sequence', 'builtin'],
    ['action', '3D', 'notIdentifier'],
    ['action', 'class', 'notIdentifier'],
    ['tree', 'MainTree', 'taken'],
    ['tree', 'maintree', 'taken'],
    ['tree', 'Sequence', null],
    ['tree', 'my-tree.2', null],
    ['tree', 'a b', 'notIdentifier'],
    ['tree', 'a/b', 'notIdentifier'],
    ['tree', ' ', 'empty'],
    ['file', '../secret', 'notPath'],
    ['file', 'a/../b', 'notPath'],
    ['file', '/etc', 'notPath'],
    ['file', '.hidden', 'notPath'],
    ['file', 'a b', 'notPath'],
    ['file', 'assets/map.yaml', null],
    ['file', 'A.md', 'taken'],
    ['universe', 'yard', 'taken'],
    ['universe', 'None', 'meansNone'],
    ['universe', 'none-at-all', null],
    ['universe', '1st', 'notId'],
    ['universe', 'a.b', 'notId'],
    ['robot', 'none', null],
    ['robot', 'mine', 'taken'],
    ['robot', 'my_robot-2', null],
    ['robot', 'a/b', 'notId'],
    ['robot', '', 'empty'],
  ] as const)('%s %s: %s', (kind, name, problem) => {
    expect(nameProblem(kind, name, taken)).toBe(problem);
  });
});
