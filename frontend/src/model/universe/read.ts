import { color, flag, number, numbers, pose, text, vector } from '../document/reading';
import { areaOf, areasIn } from './areas';
import { checkUniverse } from './rules';
import { placed, remembering, valueOfYaml, type DocumentProblem } from '../document/yaml';
import { isObject, type Json, type JsonObject, type Path, type Point } from '../document/values';
import {
  SECTIONS,
  SIZE_MEANING,
  type ActorThing,
  type Light,
  type ModelThing,
  type RobotThing,
  type Shape,
  type Thing,
  type Universe,
} from './types';

/** The result of reading a text; `universe` is null if the text is not YAML, or not a mapping. */
export interface Reading {
  readonly universe: Universe | null;
  readonly problems: readonly DocumentProblem[];
}

/** Reads a universe; equal texts give the same object (cached). */
export const readUniverse: (text: string) => Reading = remembering(read);

function read(source: string): Reading {
  const said = valueOfYaml(source);
  if ('problems' in said) return { universe: null, problems: said.problems };
  const universe = isObject(said.raw) ? universeOf(said.raw) : null;
  const thingAt = ([section, index]: Path) =>
    universe?.things.find(
      (thing) =>
        thing.section === section && (section === 'areas' ? thing.id === index : thing.index === index),
    )?.key ?? null;
  return { universe, problems: placed(source, checkUniverse(said.raw), thingAt) };
}

function universeOf(raw: JsonObject): Universe {
  const ground = isObject(raw['ground']) ? raw['ground'] : {};
  const view = isObject(raw['view']) ? raw['view'] : {};
  const lights = Array.isArray(raw['lights']) ? (raw['lights'] as Json[]) : [{}];
  return {
    raw,
    name: text(raw['name'], ''),
    description: text(raw['description'], ''),
    ground: {
      color: color(ground['color'], ground['texture'] ? '#ffffff' : '#d8d4cc'),
      texture: text(ground['texture'], ''),
      tile: tileOf(ground['tile']),
      friction: number(ground['friction'], 0.9),
    },
    ceiling: ceilingOf(raw['ceiling']),
    things: thingsOf(raw),
    lights: lights.map((light): Light => {
      const said = isObject(light) ? light : {};
      return {
        direction: vector(said['direction'], [0.3, 0.4, -0.8]),
        intensity: number(said['intensity'], 1),
      };
    }),
    view: { eye: vector(view['eye'], [-4.5, -5, 4.5]), target: vector(view['target'], [0, 0, 0.2]) },
    random: randomOf(raw['random']),
  };
}

function ceilingOf(said: unknown): Universe['ceiling'] {
  if (!isObject(said)) return null;
  return {
    color: color(said['color'], said['texture'] ? '#ffffff' : '#e8e6e0'),
    texture: text(said['texture'], ''),
    tile: tileOf(said['tile']),
    height: number(said['height'], 2.5),
  };
}

function tileOf(value: unknown): Point | null {
  const [width = 0, height = 0] = numbers(value, [0, 0]);
  return width > 0 && height > 0 ? [width, height] : null;
}

function randomOf(value: unknown): Universe['random'] {
  if (!isObject(value)) return {};
  return Object.fromEntries(
    Object.entries(value).map(([key, range]) => [key, numbers(range, [0, 0]) as [number, number]]),
  );
}

/** Returns all things that have a place; a document without robots has a default one. */
function thingsOf(raw: JsonObject): Thing[] {
  const things: Thing[] = [];
  const keys = new Set<string>();
  const keyOf = (id: string): string => {
    let key = id;
    for (let count = 2; keys.has(key); count += 1) key = `${id}#${count}`;
    keys.add(key);
    return key;
  };
  for (const section of SECTIONS) {
    const list = section in raw ? raw[section] : section === 'robots' ? [{}] : [];
    if (!Array.isArray(list)) continue;
    for (const [index, said] of (list as Json[]).entries()) {
      if (!isObject(said)) continue;
      const id = text(said['id'], section === 'robots' ? 'robot' : '');
      const thing = thingOf(said, { key: keyOf(id), id, index, section });
      if (thing) things.push(thing);
    }
  }
  for (const [index, [id, said]] of areasIn(raw).entries()) {
    const area = areaOf(said, { key: keyOf(id), id, index });
    if (area) things.push(area);
  }
  return things;
}

function thingOf(
  said: JsonObject,
  { section, ...placed }: { key: string; id: string; index: number; section: (typeof SECTIONS)[number] },
): Thing | null {
  if (section === 'models') return modelOf(said, { section, ...placed });
  if (section === 'actors') return actorOf(said, { section, ...placed });
  const model = text(said['model'], 'turtle2');
  const named = isObject(said['topics']) ? Object.entries(said['topics']) : [];
  const topics = Object.fromEntries(
    named.filter((row): row is [string, string] => typeof row[1] === 'string'),
  );
  return { section, ...placed, model, pose: pose(said['pose']), topics } satisfies RobotThing;
}

function modelOf(
  said: JsonObject,
  placed: Pick<ModelThing, 'key' | 'id' | 'index' | 'section'>,
): ModelThing | null {
  const shape = said['shape'];
  if (typeof shape !== 'string' || !Object.hasOwn(SIZE_MEANING, shape)) return null;
  const wanted = SIZE_MEANING[shape as Shape].map(() => 1);
  return {
    ...placed,
    shape: shape as Shape,
    size: numbers(said['size'], wanted).map((part) => (part > 0 ? part : 1)),
    file: text(said['file'], ''),
    pose: pose(said['pose']),
    color: color(said['color'], said['texture'] ? '#ffffff' : '#9aa4b0'),
    texture: text(said['texture'], ''),
    tile: tileOf(said['tile']),
    mass: number(said['mass'], 0),
    friction: number(said['friction'], 0.6),
    restitution: number(said['restitution'], 0),
    solid: flag(said['solid'], true),
    to_ceiling: flag(said['to_ceiling'], false),
  };
}

function actorOf(
  said: JsonObject,
  placed: Pick<ActorThing, 'key' | 'id' | 'index' | 'section'>,
): ActorThing | null {
  const path = Array.isArray(said['path']) ? (said['path'] as Json[]) : [];
  const points = path.map((point) => numbers(point, [NaN, NaN]) as Point).filter(([x]) => !Number.isNaN(x));
  if (points.length === 0 || points.length !== path.length) return null;
  return {
    ...placed,
    color: color(said['color'], '#20c020'),
    path: points,
    speed: number(said['speed'], 0.5),
    loop: flag(said['loop'], true),
    start_m: number(said['start_m'], 0),
    yields: flag(said['yields'], false),
  };
}
