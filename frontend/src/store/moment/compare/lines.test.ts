import { expect, it } from 'vitest';
import { courseOf, partedAt, piecesFrom } from './lines';

const branches = [
  { run: 'b', parent: 'a', from_t: 3 },
  { run: 'c', parent: 'a', from_t: 5 },
  { run: 'd', parent: 'b', from_t: 6 },
  { run: 'early', parent: 'd', from_t: 4 },
];
const parted = (one: string, other: string) => partedAt(courseOf(one, branches), courseOf(other, branches));

it('follows a branch back to the run that continues no other', () => {
  expect(courseOf('a', branches)).toEqual([{ run: 'a', from: -Infinity, to: Infinity }]);
  expect(courseOf('d', branches)).toEqual([
    { run: 'a', from: -Infinity, to: 3 },
    { run: 'b', from: 3, to: 6 },
    { run: 'd', from: 6, to: Infinity },
  ]);
});

it('leaves out a run of which nothing was kept', () => {
  expect(courseOf('early', branches)).toEqual([
    { run: 'a', from: -Infinity, to: 3 },
    { run: 'b', from: 3, to: 4 },
    { run: 'early', from: 4, to: Infinity },
  ]);
});

it.each([
  ['a', 'b', 3],
  ['c', 'b', 3],
  ['c', 'd', 3],
  ['b', 'd', 6],
  ['d', 'early', 4],
])('finds where %s and %s part', (one, other, t) => {
  expect(parted(one, other)).toBe(t);
  expect(parted(other, one)).toBe(t);
});

it('finds nothing in common between two runs of their own', () => {
  expect(parted('a', 'another')).toBeNull();
});

it('does not follow a circle', () => {
  const circle = [
    { run: 'x', parent: 'y', from_t: 2 },
    { run: 'y', parent: 'x', from_t: 1 },
  ];
  expect(courseOf('x', circle)).toEqual([
    { run: 'y', from: 1, to: 2 },
    { run: 'x', from: 2, to: Infinity },
  ]);
});

it('cuts a course at a time', () => {
  expect(piecesFrom(courseOf('d', branches), 4)).toEqual([
    { run: 'b', from: 4, to: 6 },
    { run: 'd', from: 6, to: Infinity },
  ]);
});
