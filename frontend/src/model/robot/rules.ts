import schema from '@/generated/robot.schema.json';
import { validate } from '@/generated/robot.schema.json?validator';
import { checkSchema, type Issue } from '../document/schema';
import { isObject, type Json, type JsonObject, type Path } from '../document/values';
import { similarNames } from '../similar';
import type { SensorKind } from './types';
import type { Urdf } from './urdf';

/** Returns all problems of a `robot.yaml` alone. */
export function checkConfig(raw: Json): Issue[] {
  const found = checkSchema(raw, validate);
  const sensors = isObject(raw) && Array.isArray(raw['sensors']) ? (raw['sensors'] as Json[]) : [];
  for (const [index, sensor] of sensors.entries()) {
    if (!isObject(sensor) || sensor['kind'] !== 'lidar') continue;
    const { range_min: low = 0.12, range_max: high = 8 } = sensor;
    if (typeof low === 'number' && typeof high === 'number' && low >= high)
      found.push({ path: ['sensors', index], kind: 'rangeOrder', params: {} });
  }
  return found;
}

/** Reports links and joints that the URDF does not contain (executor/robots/config.py). */
export function checkNames(raw: JsonObject, urdf: Urdf): Issue[] {
  const found: Issue[] = [];
  const check = (what: 'link' | 'joint', path: Path, name: Json | undefined) => {
    const known: ReadonlyMap<string, unknown> = what === 'link' ? urdf.links : urdf.joints;
    if (typeof name !== 'string' || known.has(name)) return;
    const [near] = similarNames(name, [...known.keys()], 1);
    const kind = what === 'link' ? 'noLink' : 'noJoint';
    found.push({ path, kind: near ? `${kind}Near` : kind, params: { name, ...(near ? { near } : {}) } });
  };
  const each = (value: Json | undefined, visit: (part: Json, index: number) => void) => {
    if (Array.isArray(value)) (value as Json[]).forEach(visit);
  };
  const drive = isObject(raw['drive']) ? raw['drive'] : {};
  each(raw['wheels'], (name, index) => check('link', ['wheels', index], name));
  for (const field of ['friction', 'skid']) {
    const map = raw[field];
    if (isObject(map)) for (const name of Object.keys(map)) check('link', [field, name], name);
  }
  each(raw['sensors'], (sensor, index) => {
    if (isObject(sensor) && sensor['kind'] !== 'battery')
      check('link', ['sensors', index, 'link'], sensor['link']);
  });
  for (const side of ['left', 'right'])
    each(drive[side], (name, index) => check('joint', ['drive', side, index], name));
  const wheels = new Set(
    ['left', 'right'].flatMap((side) => (Array.isArray(drive[side]) ? (drive[side] as Json[]) : [])),
  );
  each(raw['joints'], (driven, index) => {
    if (!isObject(driven)) return;
    check('joint', ['joints', index, 'joint'], driven['joint']);
    const joint = urdf.joints.get(String(driven['joint']));
    const isFree = joint && ['revolute', 'continuous', 'prismatic'].includes(joint.type);
    if (joint && (!isFree || wheels.has(joint.name)))
      found.push({ path: ['joints', index, 'joint'], kind: 'noMotor', params: { joint: joint.name } });
  });
  return found;
}

/** A field of a sensor or the drive, as the schema declares it. */
export interface Field {
  readonly name: string;
  readonly kind: 'number' | 'count' | 'topic';
  readonly fallback: number | string;
  readonly low: number;
  readonly high: number;
  /** Whether the field may be omitted and has no default. */
  readonly isOptional: boolean;
}

/** The objects of the schema: a sensor, the drive, or the motor of a joint. */
export type FieldsOf = SensorKind | 'drive' | 'motor';

const DEFINITIONS: Readonly<Record<FieldsOf, keyof typeof schema.$defs>> = {
  lidar: 'Lidar',
  camera: 'Camera',
  imu: 'Imu',
  bumper: 'Bumper',
  battery: 'Battery',
  drive: 'Drive',
  motor: 'JointDrive',
};

interface Property {
  readonly type?: string;
  readonly default?: unknown;
  readonly pattern?: string;
  readonly minimum?: number;
  readonly maximum?: number;
  readonly exclusiveMinimum?: number;
  readonly exclusiveMaximum?: number;
  readonly anyOf?: readonly Property[];
}

/** The smallest value for a field whose bound is exclusive. */
const LEAST = 0.001;

/** Returns the number and topic fields of a sensor, the drive, or a joint's motor. */
export function fieldsOf(kind: FieldsOf): Field[] {
  const { properties } = schema.$defs[DEFINITIONS[kind]] as {
    properties: Readonly<Record<string, Property>>;
  };
  return Object.entries(properties).flatMap(([name, property]): Field[] => {
    const said = property.anyOf?.[0] ?? property;
    const isTopic = said.pattern?.startsWith('^/') ?? false;
    if (!isTopic && said.type !== 'number' && said.type !== 'integer') return [];
    const { exclusiveMinimum: above, exclusiveMaximum: under } = said;
    return [
      {
        name,
        kind: isTopic ? 'topic' : said.type === 'integer' ? 'count' : 'number',
        fallback: (property.default as number | string | null | undefined) ?? (isTopic ? '' : 0),
        low: said.minimum ?? (above === undefined ? -1e6 : above + LEAST),
        high: said.maximum ?? (under === undefined ? 1e6 : under - LEAST),
        isOptional: property.anyOf !== undefined,
      },
    ];
  });
}
