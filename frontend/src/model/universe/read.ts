import { isMap, isScalar, isSeq, LineCounter, parseDocument, type Document, type Node } from 'yaml';
import { checkUniverse } from './rules';
import type { Issue } from './schema';
import {
  isObject,
  SECTIONS,
  SIZE_MEANING,
  type ActorThing,
  type Json,
  type JsonObject,
  type Light,
  type ModelThing,
  type Path,
  type Point,
  type Pose,
  type RobotThing,
  type Section,
  type Shape,
  type Thing,
  type Universe,
  type Vector,
} from './types';

/** An issue at its place in the text; line and column count from 1. */
export interface UniverseProblem extends Issue {
  readonly line: number;
  readonly column: number;
  /** Where it is about a thing: the thing's key. */
  readonly thing: string | null;
}

/** A text as far as it can be read; without a universe it is no YAML, or no mapping. */
export interface Reading {
  readonly universe: Universe | null;
  readonly problems: readonly UniverseProblem[];
}

/** The simulator reads YAML 1.1. */
export const YAML_OPTIONS = { version: '1.1', uniqueKeys: true, logLevel: 'silent' } as const;

/** A universe need not be longer; the simulator refuses what is. */
const LONGEST = 2_000_000;

/** The texts before and after the last edit, which are asked for again and again. */
const KEPT = 3;

function remembering<T>(make: (text: string) => T): (text: string) => T {
  let known: { text: string; made: T }[] = [];
  return (text) => {
    const old = known.find((each) => each.text === text);
    if (old) return old.made;
    const made = make(text);
    known = [{ text, made }, ...known].slice(0, KEPT);
    return made;
  };
}

/** A text as YAML; nobody changes what this returns. */
export const parsed = remembering((text) => {
  const lines = new LineCounter();
  return { document: parseDocument(text, { ...YAML_OPTIONS, lineCounter: lines }), lines };
});

/** Reads a universe; texts that were read a moment ago give the same object. */
export const readUniverse: (text: string) => Reading = remembering(read);

function read(text: string): Reading {
  if (text.length > LONGEST) {
    return unreadable([
      { path: [], kind: 'tooLong', params: { most: LONGEST }, line: 1, column: 1, thing: null },
    ]);
  }
  const { document, lines } = parsed(text);
  if (document.errors.length > 0) {
    return unreadable(
      document.errors.map(({ message, pos: [start] }) => ({
        path: [],
        kind: 'syntax',
        params: { message: (message.split(' at line')[0] ?? message).split('\n')[0] ?? message },
        ...placeAt(lines, start),
        thing: null,
      })),
    );
  }
  let raw: Json;
  try {
    raw = document.toJS({ maxAliasCount: 100 }) as Json;
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    return unreadable([{ path: [], kind: 'syntax', params: { message }, line: 1, column: 1, thing: null }]);
  }
  const universe = isObject(raw) ? universeOf(raw) : null;
  const problems = checkUniverse(raw).map((issue) => ({
    ...issue,
    ...placeAt(lines, offsetOf(document, issue.path)),
    thing:
      universe?.things.find(({ section, index }) => section === issue.path[0] && index === issue.path[1])
        ?.key ?? null,
  }));
  return { universe, problems: problems.sort((a, b) => a.line - b.line || a.column - b.column) };
}

const unreadable = (problems: UniverseProblem[]): Reading => ({ universe: null, problems });

function placeAt(lines: LineCounter, offset: number): { line: number; column: number } {
  const { line, col } = lines.linePos(offset);
  return { line: Math.max(line, 1), column: Math.max(col, 1) };
}

/** Where the part of a document at a path begins, or else the nearest part round it. */
function offsetOf(document: Document, path: Path): number {
  let node = document.contents as Node | null;
  let offset = node?.range?.[0] ?? 0;
  for (const step of path) {
    if (isMap(node)) {
      const pair = node.items.find(({ key }) => isScalar(key) && String(key.value) === String(step));
      if (!pair) break;
      offset = (pair.key as Node).range?.[0] ?? offset;
      node = pair.value as Node | null;
    } else if (isSeq(node)) {
      node = (node.items[Number(step)] ?? null) as Node | null;
      offset = node?.range?.[0] ?? offset;
    } else break;
  }
  return offset;
}

const number = (value: unknown, fallback: number): number =>
  typeof value === 'number' && Number.isFinite(value) ? value : fallback;
const text = (value: unknown, fallback: string): string => (typeof value === 'string' ? value : fallback);
const flag = (value: unknown, fallback: boolean): boolean => (typeof value === 'boolean' ? value : fallback);
const color = (value: unknown, fallback: string): string =>
  typeof value === 'string' && /^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$/.test(value) ? value : fallback;

function numbers(value: unknown, fallback: readonly number[]): readonly number[] {
  const isRight = Array.isArray(value) && value.length === fallback.length;
  return isRight && value.every((part) => typeof part === 'number' && Number.isFinite(part))
    ? (value as number[])
    : fallback;
}

const vector = (value: unknown, fallback: Vector) => numbers(value, fallback) as Vector;
const pose = (value: unknown) => numbers(value, [0, 0, 0, 0, 0, 0]) as Pose;

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
      friction: number(ground['friction'], 0.9),
    },
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

function randomOf(value: unknown): Universe['random'] {
  if (!isObject(value)) return {};
  return Object.fromEntries(
    Object.entries(value).map(([key, range]) => [key, numbers(range, [0, 0]) as [number, number]]),
  );
}

/** Everything that has a place; a document that names no robot has one. */
function thingsOf(raw: JsonObject): Thing[] {
  const things: Thing[] = [];
  const keys = new Set<string>();
  for (const section of SECTIONS) {
    const list = section in raw ? raw[section] : section === 'robots' ? [{}] : [];
    if (!Array.isArray(list)) continue;
    for (const [index, said] of (list as Json[]).entries()) {
      if (!isObject(said)) continue;
      const id = text(said['id'], section === 'robots' ? 'robot' : '');
      let key = id;
      for (let count = 2; keys.has(key); count += 1) key = `${id}#${count}`;
      keys.add(key);
      const thing = thingOf(said, { key, id, index, section });
      if (thing) things.push(thing);
    }
  }
  return things;
}

function thingOf(
  said: JsonObject,
  { section, ...placed }: { key: string; id: string; index: number; section: Section },
): Thing | null {
  if (section === 'models') return modelOf(said, { section, ...placed });
  if (section === 'actors') return actorOf(said, { section, ...placed });
  const model = text(said['model'], 'turtle2');
  return { section, ...placed, model, pose: pose(said['pose']) } satisfies RobotThing;
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
    mass: number(said['mass'], 0),
    friction: number(said['friction'], 0.6),
    restitution: number(said['restitution'], 0),
    solid: flag(said['solid'], true),
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
  };
}
