import { checkSchema, type Issue } from '../document/schema';
import { isObject, type Json, type JsonObject, type Path } from '../document/values';
import { areaFault, areasIn } from './areas';
import { FILES, PICTURE, TEXTURES, SECTIONS, SIZE_MEANING, type Shape } from './types';
import { validate } from '@/generated/universe.schema.json?validator';

const AXES = ['x', 'y', 'z', 'roll', 'pitch', 'yaw'];
const RANDOM_KEY = /^(?<id>[\w-]+)\.(?:pose\.(?<axis>\w+)|(?<field>mass|friction|speed))$/;

/** The fields that `random` can vary, by section. */
const VARIABLE: Readonly<Record<string, readonly string[]>> = {
  models: ['pose', 'mass', 'friction'],
  actors: ['speed'],
  robots: ['pose'],
};

/**
 * Returns all problems of a document: those of the schema, which is generated from the simulator's model,
 * then those that a schema cannot express (executor/universes/model.py).
 */
export function checkUniverse(raw: Json): Issue[] {
  const found = checkSchema(raw, validate);
  if (!isObject(raw)) return found;
  const models = Array.isArray(raw['models']) ? (raw['models'] as Json[]) : [];
  const own = models.flatMap((model, index) => (isObject(model) ? checkModel(model, ['models', index]) : []));
  const painted = ['ground', 'ceiling'].flatMap((name) => {
    const said = raw[name];
    return isObject(said) ? checkPaint(said, [name]) : [];
  });
  const areas = areasIn(raw).flatMap(([name, area]): Issue[] => {
    const kind = areaFault(area);
    return kind ? [{ path: ['areas', name], kind, params: {} }] : [];
  });
  return [
    ...[...found, ...own, ...painted, ...areas],
    ...[...checkLights(raw), ...checkIds(raw), ...checkRandom(raw)],
  ];
}

function checkModel(model: JsonObject, path: Path): Issue[] {
  const shape = model['shape'];
  if (typeof shape !== 'string' || !Object.hasOwn(SIZE_MEANING, shape)) return [];
  const found = [
    ...checkFile(model, shape as Shape, path),
    ...checkSize(model, shape as Shape, path),
    ...checkPaint(model, path),
  ];
  const isHeavy = typeof model['mass'] === 'number' && model['mass'] > 0;
  if (isHeavy && shape === 'plane') found.push({ path: [...path, 'mass'], kind: 'planeMass', params: {} });
  else if (isHeavy && model['solid'] === false) {
    found.push({ path: [...path, 'mass'], kind: 'ghostMass', params: {} });
  }
  if (model['to_ceiling'] === true && (shape !== 'box' || isHeavy || leans(model['pose']))) {
    found.push({ path: [...path, 'to_ceiling'], kind: 'toCeiling', params: {} });
  }
  return found;
}

/** Returns whether a pose has a roll or a pitch. */
function leans(pose: Json | undefined): boolean {
  return Array.isArray(pose) && pose.slice(3, 5).some((angle) => angle !== 0);
}

function checkFile(model: JsonObject, shape: Shape, path: Path): Issue[] {
  const file = typeof model['file'] === 'string' ? model['file'] : '';
  const wanted = FILES[shape];
  if (!wanted) return file ? [{ path: [...path, 'file'], kind: 'noFile', params: { shape } }] : [];
  if (!file) return [{ path, kind: 'needsFile', params: { shape } }];
  return wanted.test(file) ? [] : [{ path: [...path, 'file'], kind: 'wrongFile', params: { shape } }];
}

function checkSize(model: JsonObject, shape: Shape, path: Path): Issue[] {
  const size = Array.isArray(model['size']) ? (model['size'] as Json[]) : [];
  const meaning = SIZE_MEANING[shape];
  if (size.length === meaning.length || (size.length === 0 && shape === 'mesh')) return [];
  const at = 'size' in model ? [...path, 'size'] : path;
  return [
    { path: at, kind: meaning.length === 0 ? 'noSize' : 'size', params: { shape, count: meaning.length } },
  ];
}

function checkPaint(painted: JsonObject, path: Path): Issue[] {
  const texture = typeof painted['texture'] === 'string' ? painted['texture'] : '';
  const isAssembly = painted['shape'] === 'urdf' || painted['shape'] === 'sdf';
  if (texture && isAssembly) return [{ path: [...path, 'texture'], kind: 'noTexture', params: {} }];
  if (texture && !(TEXTURES as readonly string[]).includes(texture) && !PICTURE.test(texture)) {
    return [{ path: [...path, 'texture'], kind: 'texture', params: { known: TEXTURES.join(', ') } }];
  }
  const hasTile = painted['tile'] !== undefined && painted['tile'] !== null;
  return hasTile && !texture ? [{ path: [...path, 'tile'], kind: 'tile', params: {} }] : [];
}

function checkLights(raw: JsonObject): Issue[] {
  const lights = Array.isArray(raw['lights']) ? (raw['lights'] as Json[]) : [];
  return lights.flatMap((light, index) => {
    const direction = isObject(light) ? light['direction'] : undefined;
    if (!Array.isArray(direction) || direction.length !== 3 || direction.some((part) => part !== 0))
      return [];
    return [{ path: ['lights', index, 'direction'], kind: 'noDirection', params: {} }];
  });
}

function* idsOf(raw: JsonObject): Generator<{ id: string; section: string; path: Path }> {
  for (const section of SECTIONS) {
    const things = raw[section] ?? (section === 'robots' ? [{}] : []);
    if (!Array.isArray(things)) continue;
    for (const [index, thing] of (things as Json[]).entries()) {
      const id = isObject(thing) ? (thing['id'] ?? (section === 'robots' ? 'robot' : null)) : null;
      if (typeof id === 'string') yield { id, section, path: [section, index, 'id'] };
    }
  }
}

function checkIds(raw: JsonObject): Issue[] {
  const taken = isObject(raw['ceiling']) ? ['ground', 'ceiling'] : ['ground'];
  const seen = new Set(taken);
  const found: Issue[] = [];
  for (const { id, path } of idsOf(raw)) {
    if (seen.has(id)) found.push({ path, kind: taken.includes(id) ? 'takenId' : 'sameId', params: { id } });
    seen.add(id);
  }
  return found;
}

function checkRandom(raw: JsonObject): Issue[] {
  if (!isObject(raw['random'])) return [];
  const sections = new Map([...idsOf(raw)].map(({ id, section }) => [id, section]));
  return Object.entries(raw['random']).flatMap(([key, range]): Issue[] => {
    const path = ['random', key];
    const match = RANDOM_KEY.exec(key)?.groups;
    const section = match ? sections.get(match['id'] ?? '') : undefined;
    const axis = match?.['axis'];
    if (!section || (axis !== undefined && !AXES.includes(axis))) {
      return [{ path, kind: 'randomName', params: { key } }];
    }
    const wanted = axis === undefined ? (match?.['field'] ?? '') : 'pose';
    if (!VARIABLE[section]?.includes(wanted)) {
      return [{ path, kind: 'randomField', params: { id: match?.['id'] ?? '', field: wanted } }];
    }
    const [low, high] = Array.isArray(range) ? (range as Json[]) : [];
    const isUpsideDown = typeof low === 'number' && typeof high === 'number' && low > high;
    return isUpsideDown ? [{ path, kind: 'randomRange', params: { key } }] : [];
  });
}
