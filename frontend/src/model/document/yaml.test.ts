import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { validate as validateRobot } from '@/generated/robot.schema.json?validator';
import { validate as validateUniverse } from '@/generated/universe.schema.json?validator';
import { checkSchema } from './schema';
import type { Json, JsonObject } from './values';
import { valueOfYaml } from './yaml';

type Scalar = string | number | boolean | null;
const { scalars, repairs } = JSON.parse(readFileSync('../tests/shared/yaml_scalars.json', 'utf-8')) as {
  scalars: [string, Scalar][];
  repairs: [string, string, string | null][];
};

const { problem: texts } = JSON.parse(readFileSync('src/i18n/locales/en/editor3d.json', 'utf-8')) as {
  problem: Record<string, string>;
};

const SPECIAL: Record<string, number> = { inf: Infinity, '-inf': -Infinity, nan: NaN };
const expected = (value: Scalar): Scalar =>
  typeof value !== 'string' ? value : value.startsWith('=') ? value.slice(1) : (SPECIAL[value] ?? NaN);

/** Returns the value of a document with one key. */
function read(text: string): Json | undefined {
  const found = valueOfYaml(`a: ${text}\n`);
  if (!('raw' in found)) throw new Error(JSON.stringify(found.problems));
  return (found.raw as JsonObject)['a'];
}

const universe = (more: JsonObject): JsonObject => ({
  format: 'bt-studio/universe',
  version: 1,
  name: 'U',
  ...more,
});
const model = (more: JsonObject): JsonObject =>
  universe({ models: [{ id: 'a', shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0], ...more }] });

/** A document with a value where this type is wanted. */
const HOLDERS: Record<string, (value: Json) => ReturnType<typeof checkSchema>> = {
  number: (value) => checkSchema(model({ mass: value }), validateUniverse),
  boolean: (value) => checkSchema(model({ solid: value }), validateUniverse),
  text: (value) => checkSchema(universe({ name: value }), validateUniverse),
  integer: (value) =>
    checkSchema({ sensors: [{ kind: 'lidar', link: 'scan', rays: value }] }, validateRobot).filter(
      ({ path }) => path.at(-1) === 'rays',
    ),
};

describe('YAML of our files', () => {
  it.each(scalars)('reads %j as Python does', (text, value) => {
    // 0 and -0 are equal in Python.
    const found = read(text);
    expect(found === 0 ? 0 : found).toBe(expected(value));
  });

  it('reads a document that names an older version alike', () => {
    expect(valueOfYaml('%YAML 1.1\n---\na: yes\n')).toEqual({ raw: { a: 'yes' } });
  });

  it.each(repairs)('wants a %s, and says of %j: %s', (wanted, text, sentence) => {
    const issues = HOLDERS[wanted]?.(read(text) ?? null) ?? [];
    expect(
      issues.map(({ kind, params }) => (texts[kind] ?? kind).replace('{{write}}', String(params['write']))),
    ).toEqual(sentence === null ? [] : [sentence]);
  });
});
