import type { Op } from '../document/ops';
import { isObject, type Json, type JsonObject, type Point } from '../document/values';
import { numbers } from '../document/reading';
import { rounded } from './geometry';
import type { AreaThing } from './types';

/** Named areas of the floor: boxes [x min, y min, x max, y max] and polygons, in m, by name. */

const FEWEST_CORNERS = 3;
const SMALLEST_M2 = 1e-6;

/** Reads an area; null if it has neither a box nor a polygon. */
export function areaOf(said: JsonObject, placed: Pick<AreaThing, 'key' | 'id' | 'index'>): AreaThing | null {
  const made = (shape: AreaThing['shape'], path: readonly Point[]): AreaThing => ({
    ...placed,
    section: 'areas',
    shape,
    path,
  });
  const [x0 = NaN, y0 = 0, x1 = 0, y1 = 0] = numbers(said['box'], [NaN, NaN, NaN, NaN]);
  if (!Number.isNaN(x0)) return made('box', cornersOf([x0, y0], [x1, y1]));
  const corners = Array.isArray(said['polygon']) ? (said['polygon'] as Json[]) : [];
  const points = corners.map((corner) => numbers(corner, [NaN, NaN]) as Point);
  const isWhole = points.length >= FEWEST_CORNERS && points.every(([x]) => !Number.isNaN(x));
  return isWhole ? made('polygon', points) : null;
}

/** Returns the corners of the box between two opposite ones, in order. */
function cornersOf([ax, ay]: Point, [bx, by]: Point): Point[] {
  const [x0, x1] = [Math.min(ax, bx), Math.max(ax, bx)];
  const [y0, y1] = [Math.min(ay, by), Math.max(ay, by)];
  return [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1],
  ];
}

/** Returns the value of an area with these corners: a box if they are the corners of one. */
export function valueOfArea(corners: readonly Point[]): JsonObject {
  const tidied = corners.map(([x, y]): Point => [rounded(x), rounded(y)]);
  const [first = [0, 0], , third = [0, 0]] = tidied;
  const box = cornersOf(first, third);
  const isBox =
    tidied.length === box.length &&
    tidied.every((corner) => box.some(([x, y]) => x === corner[0] && y === corner[1])) &&
    new Set(tidied.map(String)).size === box.length;
  const [[x0, y0] = [0, 0], , [x1, y1] = [0, 0]] = box;
  return isBox ? { box: [x0, y0, x1, y1] } : { polygon: tidied };
}

/** Returns the operations that give an area other corners, or none if they enclose nothing. */
export function reshaped({ id, shape }: AreaThing, corners: readonly Point[]): Op[] {
  if (corners.length < FEWEST_CORNERS || areaM2(corners) < SMALLEST_M2) return [];
  if (shape === 'polygon') {
    const tidied = corners.map(([x, y]): Point => [rounded(x), rounded(y)]);
    return [{ kind: 'set', path: ['areas', id, shape], value: tidied }];
  }
  const value = valueOfArea(corners);
  return 'box' in value
    ? [{ kind: 'set', path: ['areas', id, 'box'], value: value['box'] ?? null }]
    : [{ kind: 'set', path: ['areas', id], value }];
}

/** Moves one corner; a box stays a box. */
export function withCorner({ shape, path }: AreaThing, at: number, point: Point): readonly Point[] {
  if (shape === 'polygon') return path.map((corner, index) => (index === at ? point : corner));
  return cornersOf(point, path[(at + 2) % 4] ?? point);
}

/** Scales corners about a point, along x and y. */
export const scaled = (corners: readonly Point[], [px, py]: Point, [sx, sy]: Point): Point[] =>
  corners.map(([x, y]) => [px + (x - px) * Math.abs(sx), py + (y - py) * Math.abs(sy)]);

function areaM2(corners: readonly Point[]): number {
  const twice = corners.reduce((sum, [x, y], index) => {
    const [nextX, nextY] = corners[(index + 1) % corners.length] ?? [0, 0];
    return sum + x * nextY - nextX * y;
  }, 0);
  return Math.abs(twice) / 2;
}

/** The faults of an area that a schema cannot express (`executor/universes/model.py`). */
export function areaFault(said: JsonObject): 'areaShape' | 'areaBox' | 'areaLine' | null {
  const [box, polygon] = [said['box'] ?? null, said['polygon'] ?? null];
  if ((box === null) === (polygon === null)) return 'areaShape';
  const [x0 = 0, y0 = 0, x1 = 1, y1 = 1] = numbers(box ?? [], [0, 0, 1, 1]);
  if (!(x0 < x1 && y0 < y1)) return 'areaBox';
  const found = areaOf(said, { key: '', id: '', index: 0 });
  return found && areaM2(found.path) < SMALLEST_M2 ? 'areaLine' : null;
}

/** Returns the named areas of a document's value. */
export const areasIn = (raw: JsonObject): readonly (readonly [string, JsonObject])[] =>
  (isObject(raw['areas']) ? Object.entries(raw['areas']) : []).filter(
    (entry): entry is [string, JsonObject] => isObject(entry[1]),
  );
