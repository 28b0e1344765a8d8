import { describe, expect, it } from 'vitest';
import { validate as validateRobot } from '@/generated/robot.schema.json?validator';
import { validate as validateUniverse } from '@/generated/universe.schema.json?validator';
import { checkSchema } from './schema';
import type { Json, JsonObject } from './values';

const universe = (more: JsonObject) =>
  checkSchema({ format: 'bt-studio/universe', version: 1, name: 'U', ...more }, validateUniverse);
/** Returns the issues of a robot with this one sensor. */
const sensors = (sensor: Json) =>
  checkSchema({ sensors: [sensor] }, validateRobot).filter(({ path }) => path[0] === 'sensors');
const box = { id: 'a', shape: 'box', size: [1, 1, 1] };
const inBox = (more: JsonObject) => universe({ models: [{ ...box, ...more }] });
const at = ['models', 0];

describe('checkSchema', () => {
  it('finds nothing in a valid document', () => {
    expect(universe({ models: [box] })).toEqual([]);
  });

  it.each<[string, JsonObject, JsonObject]>([
    ['a wrong type', { id: 7 }, { path: [...at, 'id'], kind: 'textWrite', params: { write: '"7"' } }],
    [
      'a wrong choice',
      { solid: 'yes' },
      { path: [...at, 'solid'], kind: 'booleanWrite', params: { write: 'true' } },
    ],
    ['a number that is none', { mass: NaN }, { path: [...at, 'mass'], kind: 'number', params: {} }],
    ['no color', { color: 'red' }, { path: [...at, 'color'], kind: 'color', params: {} }],
    ['no name', { id: '1 2' }, { path: [...at, 'id'], kind: 'name', params: {} }],
    [
      'an unknown name with one like it',
      { shap: 1 },
      { path: [...at, 'shap'], kind: 'unknownNear', params: { name: 'shap', near: 'shape' } },
    ],
    [
      'a list of a wrong length',
      { pose: [1, 'x'] },
      { path: [...at, 'pose'], kind: 'exactly', params: { count: 6 } },
    ],
    [
      'an item of a list',
      { pose: [0, 0, 0, 0, 0, 'x'] },
      { path: [...at, 'pose', 5], kind: 'number', params: {} },
    ],
    [
      'a value out of its range',
      { mass: -1 },
      { path: [...at, 'mass'], kind: 'range', params: { low: 0, high: 100000 } },
    ],
    [
      'the first choice of a value that may be null',
      { tile: [0, 1] },
      { path: [...at, 'tile', 0], kind: 'above', params: { above: 0 } },
    ],
  ])('reports %s', (_, more, issue) => {
    expect(inBox(more)).toEqual([issue]);
  });

  it('reports each value once, by its first reason', () => {
    expect(inBox({ id: '-'.repeat(200) })).toEqual([
      { path: [...at, 'id'], kind: 'tooLong', params: { most: 80 } },
    ]);
    expect(universe({ version: '1' })).toEqual([
      { path: ['version'], kind: 'constant', params: { expected: '1' } },
    ]);
  });

  it('reports every missing name', () => {
    expect(universe({ models: [{}] })).toEqual([
      { path: at, kind: 'missing', params: { name: 'id' } },
      { path: at, kind: 'missing', params: { name: 'shape' } },
    ]);
  });

  it('handles names with a slash or a tilde', () => {
    expect(universe({ random: { 'a/~b': [1] } })).toEqual([
      { path: ['random', 'a/~b'], kind: 'exactly', params: { count: 2 } },
    ]);
  });

  it('reports a document that is not a mapping', () => {
    for (const value of [null, 7, []] as Json[])
      expect(checkSchema(value, validateUniverse)).toEqual([{ path: [], kind: 'object', params: {} }]);
  });

  it.each<[string, Json, JsonObject]>([
    ['no mapping', 7, { path: ['sensors', 0], kind: 'object', params: {} }],
    ['of no kind', {}, { path: ['sensors', 0], kind: 'missing', params: { name: 'kind' } }],
    [
      'of an unknown kind',
      { kind: 'radar' },
      {
        path: ['sensors', 0, 'kind'],
        kind: 'choice',
        params: { choices: 'battery, bumper, camera, imu, lidar' },
      },
    ],
    [
      'whose count is no whole number',
      { kind: 'camera', link: 'l', width: 320.5 },
      { path: ['sensors', 0, 'width'], kind: 'integer', params: {} },
    ],
  ])('reports a sensor that is %s', (_, sensor, issue) => {
    expect(sensors(sensor)).toEqual([issue]);
  });
});
