import type { Op } from '../document/ops';
import { sameValue } from '../document/ops';
import { rounded, turned } from './geometry';
import {
  isObject,
  valueAt,
  type Json,
  type JsonObject,
  type Path,
  type Point,
  type Pose,
} from '../document/values';
import { areasIn, reshaped, valueOfArea, withCorner } from './areas';
import {
  hasPath,
  thingOf,
  type ActorThing,
  type AreaThing,
  type Section,
  type Thing,
  type Universe,
} from './types';

/** A change of a universe, with the selection after it. */
export interface Edit {
  readonly ops: readonly Op[];
  readonly select?: readonly string[];
}

const placeOf = ({ section, index, id }: Thing): Path => [section, section === 'areas' ? id : index];

/**
 * Returns the operation that writes the default robot, which must exist in the document before it can be
 * changed.
 */
function written(universe: Universe, things: readonly Thing[]): Op[] {
  const isImplied = things.some(({ section }) => section === 'robots') && !('robots' in universe.raw);
  return isImplied ? [{ kind: 'set', path: ['robots'], value: [IMPLIED_ROBOT] }] : [];
}

const IMPLIED_ROBOT: JsonObject = { id: 'robot', model: 'turtle2', pose: [0, 0, 0, 0, 0, 0] };

const found = (universe: Universe, keys: readonly string[]): Thing[] =>
  keys.map((key) => thingOf(universe, key)).filter((thing) => thing !== undefined);

/** Moves things to new poses, and people to new paths; both by key. */
export function place(universe: Universe, places: ReadonlyMap<string, Pose | readonly Point[]>): Edit {
  const things = found(universe, [...places.keys()]);
  const ops = things.flatMap((thing): Op[] => {
    const where = places.get(thing.key);
    if (where === undefined) return [];
    if (thing.section === 'areas') return reshaped(thing, where as readonly Point[]);
    const field = thing.section === 'actors' ? 'path' : 'pose';
    const value = tidy(where as Json);
    return [{ kind: 'set', path: [...placeOf(thing), field], value }];
  });
  return { ops: [...written(universe, things), ...ops] };
}

/** Rounds numbers to 0.1 mm. */
function tidy(value: Json): Json {
  if (Array.isArray(value)) return (value as Json[]).map(tidy);
  return typeof value === 'number' ? rounded(value) : value;
}

/** Moves things along x, y and z, in m; people stay on the ground. */
export function move(
  universe: Universe,
  keys: readonly string[],
  [dx, dy, dz]: readonly [number, number, number],
): Edit {
  const places = new Map(
    found(universe, keys).map((thing): [string, Pose | readonly Point[]] => {
      if (hasPath(thing)) return [thing.key, thing.path.map(([x, y]): Point => [x + dx, y + dy])];
      const [x, y, z, ...angles] = thing.pose;
      return [thing.key, [x + dx, y + dy, z + dz, ...angles]];
    }),
  );
  return place(universe, places);
}

/** Turns things together about a vertical axis through a point, by rad. */
export function turn(universe: Universe, keys: readonly string[], angle: number, pivot: Point): Edit {
  const places = new Map(
    found(universe, keys).map((thing): [string, Pose | readonly Point[]] => {
      if (hasPath(thing)) return [thing.key, thing.path.map((point) => turned(point, angle, pivot))];
      const [x, y, z, roll, pitch, yaw] = thing.pose;
      return [thing.key, [...turned([x, y], angle, pivot), z, roll, pitch, wrapped(yaw + angle)]];
    }),
  );
  return place(universe, places);
}

/** Returns an angle between -pi and pi. */
const wrapped = (angle: number): number => {
  const turn = ((((angle + Math.PI) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) - Math.PI;
  return Math.abs(turn + Math.PI) < 1e-9 ? Math.PI : turn;
};

/** Sets a field of a thing; undefined removes it, so that the default applies. */
export function setField(universe: Universe, key: string, field: string, value: Json | undefined): Edit {
  const [thing] = found(universe, [key]);
  if (!thing) return { ops: [] };
  const path = [...placeOf(thing), field];
  const now = valueAt(universe.raw, path);
  const next = value === undefined ? undefined : tidy(value);
  if (sameValue(now, next)) return { ops: [] };
  const op: Op = next === undefined ? { kind: 'unset', path } : { kind: 'set', path, value: next };
  return { ops: [...written(universe, [thing]), op] };
}

export function setFieldOfAll(universe: Universe, keys: readonly string[], field: string, value: Json): Edit {
  return { ops: keys.flatMap((key) => setField(universe, key, field, value).ops) };
}

/** Sets a property of the world itself, such as its name, ground, lights or view. */
export function setWorld(universe: Universe, path: Path, value: Json): Edit {
  if (sameValue(valueAt(universe.raw, path), value)) return { ops: [] };
  const [top] = path;
  const isLight = top === 'lights' && !('lights' in universe.raw);
  const before: Op[] = isLight
    ? [
        {
          kind: 'set',
          path: ['lights'],
          value: universe.lights.map((light) => ({ ...light })) as unknown as Json,
        },
      ]
    : [];
  // A missing mapping is written together with its first value.
  const isNew =
    path.length === 2 &&
    typeof top === 'string' &&
    !isLight &&
    !isObject(universe.raw[top]) &&
    top !== 'lights';
  const op: Op = isNew
    ? { kind: 'set', path: [top], value: { [String(path[1])]: tidy(value) } }
    : { kind: 'set', path, value: tidy(value) };
  return { ops: [...before, op] };
}

/** Returns a free id: the wanted one, or one with a number. */
export function freeId(universe: Universe, wish: string): string {
  const taken = new Set(['ground', ...universe.things.map(({ id }) => id)]);
  if (!taken.has(wish)) return wish;
  const stem = wish.replace(/_\d+$/, '');
  for (let count = 2; ; count += 1) if (!taken.has(`${stem}_${count}`)) return `${stem}_${count}`;
}

const ID = /^[A-Za-z_][A-Za-z0-9_-]*$/;

/** Returns the reason why an id is invalid for a thing; null if it is valid. */
export function idProblem(universe: Universe, key: string, id: string): 'name' | 'sameId' | 'tooLong' | null {
  if (!ID.test(id)) return 'name';
  if (id.length > 80) return 'tooLong';
  const isTaken = id === 'ground' || universe.things.some((thing) => thing.id === id && thing.key !== key);
  return isTaken ? 'sameId' : null;
}

/** Adds things to the end of a section. */
export function add(universe: Universe, section: Section, things: readonly JsonObject[]): Edit {
  const select = things.map(({ id }) => String(id));
  if (things.length === 0) return { ops: [] };
  if (section === 'areas') return { ops: addAreas(universe, things), select };
  const implied = section === 'robots' ? written(universe, universe.things) : [];
  const list = implied.length > 0 ? [IMPLIED_ROBOT] : universe.raw[section];
  const op: Op = Array.isArray(list)
    ? { kind: 'insert', path: [section], index: list.length, values: things }
    : { kind: 'set', path: [section], value: things };
  return { ops: [...implied, op], select };
}

/** Returns the operations that add areas, which are a mapping by name. */
function addAreas(universe: Universe, areas: readonly JsonObject[]): Op[] {
  const named = areas.map(({ id, ...area }) => [String(id), area] as const);
  if (!isObject(universe.raw['areas'])) {
    return [{ kind: 'set', path: ['areas'], value: Object.fromEntries(named) }];
  }
  return named.map(([name, value]) => ({ kind: 'set', path: ['areas', name], value }));
}

/** Returns the value of a section's item, as a copy. */
export const valueOf = (universe: Universe, thing: Thing): JsonObject => {
  const value = valueAt(universe.raw, placeOf(thing));
  return isObject(value) ? value : IMPLIED_ROBOT;
};

/** Copies things, shifted by an offset in m. */
export function duplicate(universe: Universe, keys: readonly string[], [dx, dy]: Point): Edit {
  const ids: string[] = [];
  const added = new Map<Section, JsonObject[]>();
  for (const thing of found(universe, keys)) {
    const taken = { ...universe, things: [...universe.things, ...ids.map((id) => ({ ...thing, id }))] };
    const id = freeId(taken, thing.id || 'thing');
    ids.push(id);
    const copy = { ...valueOf(universe, thing), id, ...shifted(thing, dx, dy) };
    added.set(thing.section, [...(added.get(thing.section) ?? []), copy]);
  }
  const ops = [...added].flatMap(([section, things]) => add(universe, section, things).ops);
  return { ops, select: ids };
}

function shifted(thing: Thing, dx: number, dy: number): JsonObject {
  if (hasPath(thing)) {
    const path = thing.path.map(([x, y]): Point => [rounded(x + dx), rounded(y + dy)]);
    return thing.section === 'areas' ? valueOfArea(path) : { path };
  }
  const [x, y, ...rest] = thing.pose;
  return { pose: [rounded(x + dx), rounded(y + dy), ...rest] };
}

/** Deletes things, and their entries in `random`. */
export function remove(universe: Universe, keys: readonly string[]): Edit {
  const things = found(universe, keys);
  const ids = new Set(things.map(({ id }) => id));
  const ops = (['models', 'actors', 'robots'] as const).flatMap((section): Op[] => {
    const indexes = things.filter((thing) => thing.section === section).map(({ index }) => index);
    return indexes.length > 0 ? [{ kind: 'remove', path: [section], indexes }] : [];
  });
  const areas = things.filter(({ section }) => section === 'areas').map(({ id }) => id);
  const areaOps = areas.map((id): Op => ({ kind: 'unset', path: ['areas', id] }));
  if (areas.length > 0 && areas.length === areasIn(universe.raw).length)
    areaOps.splice(0, areas.length, { kind: 'unset', path: ['areas'] });
  return {
    ops: [...written(universe, things), ...ops, ...areaOps, ...withoutRandom(universe, (id) => ids.has(id))],
    select: [],
  };
}

const randomId = (key: string): string => key.split('.')[0] ?? '';

function withoutRandom(universe: Universe, isGone: (id: string) => boolean): Op[] {
  const { random } = universe.raw;
  if (!isObject(random)) return [];
  const gone = Object.keys(random).filter((key) => isGone(randomId(key)));
  if (gone.length > 0 && gone.length === Object.keys(random).length)
    return [{ kind: 'unset', path: ['random'] }];
  return gone.map((key) => ({ kind: 'unset', path: ['random', key] }));
}

/** Changes the id of a thing, and its references in `random`. */
export function rename(universe: Universe, key: string, id: string): Edit {
  const [thing] = found(universe, [key]);
  if (!thing || thing.id === id || idProblem(universe, key, id) !== null) return { ops: [] };
  if (thing.section === 'areas')
    return { ops: [{ kind: 'rename', path: ['areas', thing.id], to: id }], select: [id] };
  const { ops } = setField(universe, key, 'id', id);
  const { random } = universe.raw;
  const names = isObject(random) ? Object.keys(random).filter((name) => randomId(name) === thing.id) : [];
  if (names.length === 0 || !isObject(random)) return { ops, select: [id] };
  const renamed = Object.entries(random).map(([name, range]) => [
    names.includes(name) ? name.replace(thing.id, id) : name,
    range,
  ]);
  const op: Op = { kind: 'set', path: ['random'], value: Object.fromEntries(renamed) as JsonObject };
  return { ops: [...ops, op], select: [id] };
}

/** Moves one waypoint of a person's path, or one corner of an area. */
export function setWaypoint(universe: Universe, key: string, at: number, point: Point): Edit {
  const thing = pathOf(universe, key);
  if (!thing || at >= thing.path.length) return { ops: [] };
  const path =
    thing.section === 'areas'
      ? withCorner(thing, at, point)
      : thing.path.map((own, index) => (index === at ? point : own));
  return place(universe, new Map([[key, path]]));
}

/** Adds a waypoint to a person's path, or a corner to an area, after the given one. */
export function addWaypoint(universe: Universe, key: string, after: number, point: Point): Edit {
  const thing = pathOf(universe, key);
  if (!thing) return { ops: [] };
  if (thing.section === 'areas') return { ops: reshaped(thing, thing.path.toSpliced(after + 1, 0, point)) };
  const value: Json = [rounded(point[0]), rounded(point[1])];
  return { ops: [{ kind: 'insert', path: [...placeOf(thing), 'path'], index: after + 1, values: [value] }] };
}

/** Removes a waypoint from a person's path, but never the last one, or a corner of more than three. */
export function removeWaypoint(universe: Universe, key: string, at: number): Edit {
  const thing = pathOf(universe, key);
  if (!thing || thing.path.length < 2 || at >= thing.path.length) return { ops: [] };
  if (thing.section === 'areas') return { ops: reshaped(thing, thing.path.toSpliced(at, 1)) };
  return { ops: [{ kind: 'remove', path: [...placeOf(thing), 'path'], indexes: [at] }] };
}

function pathOf(universe: Universe, key: string): ActorThing | AreaThing | null {
  const [thing] = found(universe, [key]);
  return thing && hasPath(thing) ? thing : null;
}
