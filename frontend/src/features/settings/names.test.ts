import { expect, it } from 'vitest';
import { projectNameProblem } from './names';

it.each([
  ['Patrol', null],
  [' ', 'empty'],
  ['é'.repeat(100), null],
  ['é'.repeat(101), 'long'],
  ['🤖'.repeat(100), null],
  ['a/b', 'path'],
  ['a\\b', 'path'],
  ['..', 'path'],
  ['.a', null],
] as const)('“%s”: %s', (name, problem) => {
  expect(projectNameProblem(name)).toBe(problem);
});
