import { describe, expect, it } from 'vitest';
import { rewrite } from '../document/rewrite';
import { areaFault, reshaped, scaled, valueOfArea, withCorner } from './areas';
import {
  add,
  addWaypoint,
  duplicate,
  move,
  remove,
  removeWaypoint,
  rename,
  setWaypoint,
  turn,
} from './edits';
import type { Edit } from './edits';
import { positionOf } from './geometry';
import { readUniverse } from './read';
import { thingOf, type AreaThing, type Universe } from './types';

const TEXT = `format: bt-studio/universe
version: 1
name: Flat
areas:
  door: {box: [1, 2, 3, 4]}   # where it ends
  corner: {polygon: [[0, 0], [2, 0], [0, 2]]}
`;

const universeOf = (text: string): Universe => readUniverse(text).universe!;
const edited = (make: (universe: Universe) => Edit, text = TEXT): string =>
  rewrite(text, make(universeOf(text)).ops);
const area = (text: string, name: string) => thingOf(universeOf(text), name) as AreaThing;

describe('areas of a universe', () => {
  it('are things of it, with their corners', () => {
    expect(readUniverse(TEXT).problems).toEqual([]);
    expect(area(TEXT, 'door')).toMatchObject({ section: 'areas', shape: 'box' });
    expect(area(TEXT, 'door').path).toEqual([
      [1, 2],
      [3, 2],
      [3, 4],
      [1, 4],
    ]);
    expect(positionOf(area(TEXT, 'door'))).toEqual([2, 3]);
    expect(area(TEXT, 'corner')).toMatchObject({ shape: 'polygon' });
  });

  it.each([
    ['{}', 'areaShape'],
    ['{box: [0, 0, 1, 1], polygon: [[0, 0], [1, 0], [0, 1]]}', 'areaShape'],
    ['{box: [0, 0, 0, 1]}', 'areaBox'],
    ['{box: [2, 0, 1, 1]}', 'areaBox'],
    ['{polygon: [[0, 0], [1, 1], [2, 2]]}', 'areaLine'],
    ['{polygon: [[0, 0], [1, 1]]}', 'atLeast'],
    ['{box: [0, 0, 1]}', 'exactly'],
    ['{circle: 1}', 'unknown'],
  ])('%s is refused in its line', (value, kind) => {
    const found = readUniverse(`format: bt-studio/universe\nversion: 1\nname: x\nareas:\n  a: ${value}\n`);
    expect(found.problems.map((problem) => [problem.kind, problem.line])).toContainEqual([kind, 5]);
  });

  it('move, and a box stays a box until it is turned', () => {
    const moved = edited((now) => move(now, ['door', 'corner'], [1, -1, 0]));
    expect(moved).toBe(
      TEXT.replace('[1, 2, 3, 4]', '[2, 1, 4, 3]').replace(
        '[[0, 0], [2, 0], [0, 2]]',
        '[[1, -1], [3, -1], [1, 1]]',
      ),
    );
    const quarter = edited((now) => turn(now, ['door'], Math.PI / 2, [2, 3]));
    expect(area(quarter, 'door')).toMatchObject({ shape: 'box' });
    const turned = edited((now) => turn(now, ['door'], 0.5, [2, 3]));
    expect(area(turned, 'door')).toMatchObject({ shape: 'polygon' });
    expect(readUniverse(turned).problems).toEqual([]);
  });

  it('are reshaped by their corners', () => {
    expect(edited((now) => setWaypoint(now, 'door', 0, [0, 0]))).toContain('box: [0, 0, 3, 4]');
    expect(edited((now) => setWaypoint(now, 'door', 2, [0, 0]))).toContain('box: [0, 0, 1, 2]');
    expect(edited((now) => setWaypoint(now, 'corner', 1, [5, 0]))).toContain('[[0, 0], [5, 0], [0, 2]]');
    const five = edited((now) => addWaypoint(now, 'door', 0, [2, 1]));
    expect(five).toContain('polygon: [[1, 2], [2, 1], [3, 2], [3, 4], [1, 4]]');
    expect(five).toContain('# where it ends');
    const four = edited((now) => removeWaypoint(now, 'door', 1), five);
    expect(area(four, 'door')).toMatchObject({ shape: 'polygon' });
  });

  it('never have fewer than three corners, or none between them', () => {
    expect(removeWaypoint(universeOf(TEXT), 'corner', 0).ops).toEqual([]);
    expect(setWaypoint(universeOf(TEXT), 'corner', 2, [1, 0]).ops).toEqual([]);
    expect(reshaped(area(TEXT, 'door'), [])).toEqual([]);
  });

  it('are added, copied, renamed and deleted', () => {
    const none = TEXT.slice(0, TEXT.indexOf('areas:'));
    const made = edited((now) => add(now, 'areas', [{ id: 'hall', box: [0, 0, 1, 1] }]), none);
    expect(area(made, 'hall').path[2]).toEqual([1, 1]);
    const more = edited((now) => add(now, 'areas', [{ id: 'hall', box: [0, 0, 1, 1] }]));
    expect(more).toContain('  hall: {box: [0, 0, 1, 1]}');
    const copied = duplicate(universeOf(TEXT), ['door'], [0.5, 0.5]);
    expect(copied.select).toEqual(['door_2']);
    expect(rewrite(TEXT, copied.ops)).toContain('  door_2: {box: [1.5, 2.5, 3.5, 4.5]}');
    expect(edited((now) => rename(now, 'door', 'exit'))).toBe(TEXT.replace('door:', 'exit:'));
    expect(rename(universeOf(TEXT), 'door', 'corner').ops).toEqual([]);
    expect(edited((now) => remove(now, ['door']))).not.toContain('door');
    expect(universeOf(edited((now) => remove(now, ['door', 'corner']))).raw).not.toHaveProperty('areas');
  });
});

describe('corners', () => {
  it('are a box only if they are those of one', () => {
    const box = area(TEXT, 'door').path;
    expect(valueOfArea(box)).toEqual({ box: [1, 2, 3, 4] });
    expect(valueOfArea(box.toReversed())).toEqual({ box: [1, 2, 3, 4] });
    expect(valueOfArea([...box.slice(0, 3), [1, 4.1]])).toHaveProperty('polygon');
    expect(valueOfArea([box[0]!, box[0]!, box[2]!, box[2]!])).toHaveProperty('polygon');
  });

  it('move one by one, and scale about a point', () => {
    expect(withCorner(area(TEXT, 'door'), 1, [9, 0])[1]).toEqual([9, 0]);
    expect(
      scaled(
        [
          [0, 0],
          [2, 2],
        ],
        [1, 1],
        [2, -0.5],
      ),
    ).toEqual([
      [-1, 0.5],
      [3, 1.5],
    ]);
  });

  it('have faults that a schema cannot say', () => {
    expect(areaFault({ box: [0, 0, 1, 1] })).toBeNull();
    expect(areaFault({ box: null, polygon: null })).toBe('areaShape');
  });
});
