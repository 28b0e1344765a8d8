import { rewrite } from '@/model/document/rewrite';
import {
  add,
  addWaypoint,
  duplicate,
  freeId,
  move,
  remove,
  removeWaypoint,
  setField,
  setWaypoint,
  turn,
  type Edit,
} from '@/model/universe/edits';
import { readUniverse } from '@/model/universe/read';
import { middleOf, rounded, snapped, standingHeight, wallBetween } from '@/model/universe/geometry';
import { type JsonObject, type Point } from '@/model/document/values';
import {
  hasPath,
  thingOf,
  type Section,
  type Shape,
  type Thing,
  type Universe,
} from '@/model/universe/types';
import { select, textsOf } from '@/features/editor3d/editing';
import { edit, readingOf, type UniverseEditor } from './editor';

/** The kinds of things in the palette. */
export const KINDS = [
  'wall',
  'box',
  'cylinder',
  'sphere',
  'crate',
  'ball',
  'floor',
  'person',
  'area',
] as const;
export type Kind = (typeof KINDS)[number];

const MODELS: Readonly<
  Record<Exclude<Kind, 'person' | 'area'>, { shape: Shape; size: number[] } & Record<string, unknown>>
> = {
  wall: { shape: 'box', size: [2, 0.15, 1], color: '#e9e4da' },
  box: { shape: 'box', size: [0.6, 0.6, 0.6], color: '#3f6fb5' },
  cylinder: { shape: 'cylinder', size: [0.3, 0.8], color: '#d9a441' },
  sphere: { shape: 'sphere', size: [0.35], color: '#4f9a6b' },
  crate: { shape: 'box', size: [0.4, 0.4, 0.4], color: '#c28a52', mass: 2 },
  ball: { shape: 'sphere', size: [0.12], color: '#e2543c', mass: 0.4, restitution: 0.6 },
  floor: { shape: 'plane', size: [2, 2], color: '#b8c4cf', solid: false },
};

/** A thing that can be placed: one of the palette, a mesh or a model of the project, or a robot. */
export type Placeable =
  | { readonly kind: Kind }
  | { readonly kind: 'file'; readonly shape: 'mesh' | 'urdf' | 'sdf'; readonly file: string }
  | { readonly kind: 'robot'; readonly model: string };

const nameOf = (file: string): string =>
  (file.split('/').at(-1) ?? file)
    .replace(/\.\w+$/, '')
    .replace(/[^A-Za-z0-9_-]/g, '_')
    .replace(/^(?![A-Za-z_])/, '_');

function itemOf(universe: Universe, what: Placeable, [x, y]: Point): { section: Section; item: JsonObject } {
  if (what.kind === 'robot') {
    const id = freeId(universe, 'robot');
    return { section: 'robots', item: { id, model: what.model, pose: [x, y, 0, 0, 0, 0] } };
  }
  if (what.kind === 'person') {
    const id = freeId(universe, 'person');
    const path = [
      [x, y],
      [rounded(x + 2), y],
      [rounded(x + 2), rounded(y + 2)],
    ];
    return {
      section: 'actors',
      item: { id, model: 'person', color: '#20c020', path, speed: 0.5, loop: true, yields: true },
    };
  }
  if (what.kind === 'area') {
    const box = [x - 1, y - 1, x + 1, y + 1].map(rounded);
    return { section: 'areas', item: { id: freeId(universe, 'area'), box } };
  }
  if (what.kind === 'file') {
    const id = freeId(universe, nameOf(what.file));
    return { section: 'models', item: { id, shape: what.shape, file: what.file, pose: [x, y, 0, 0, 0, 0] } };
  }
  const { shape, size, ...rest } = MODELS[what.kind];
  const pose = [x, y, standingHeight({ shape, size }), 0, 0, 0];
  return {
    section: 'models',
    item: { id: freeId(universe, what.kind), shape, size, pose, ...rest } as JsonObject,
  };
}

function adding(editor: UniverseEditor, universe: Universe, what: Placeable, at?: Point): Edit {
  const { grid } = editor.store.getState();
  const [x, y] = at ?? free(editor);
  const { section, item } = itemOf(universe, what, [snapped(x, grid), snapped(y, grid)]);
  return add(universe, section, [item]);
}

/** Places a thing on the floor: at a point, or in the middle of the view. */
export function placeThing(editor: UniverseEditor, what: Placeable, at?: Point): void {
  // The next click selects: placing a thing leaves the tool that draws walls.
  editor.store.setState({ tool: 'select' });
  edit(editor, 'add', (universe) => adding(editor, universe, what, at));
}

/**
 * Returns the thing that would be placed in the middle of the view; undefined if the text does not allow it.
 */
export function thingToPlace(editor: UniverseEditor, what: Placeable): Thing | undefined {
  const { universe } = readingOf(editor);
  if (!universe) return undefined;
  const { ops, select: [key = ''] = [] } = adding(editor, universe, what);
  try {
    const [text = ''] = textsOf(editor);
    const placed = readUniverse(rewrite(text, ops)).universe;
    return placed ? thingOf(placed, key) : undefined;
  } catch {
    return undefined;
  }
}

/** Returns the middle of the view, or a place beside it if the middle is occupied. */
function free(editor: UniverseEditor): Point {
  const [x, y] = editor.view?.center() ?? [0, 0];
  const things = readingOf(editor).universe?.things ?? [];
  const isTaken = (at: number) =>
    things.some((thing) => !hasPath(thing) && Math.hypot(thing.pose[0] - at, thing.pose[1] - y) < 0.3);
  let step = 0;
  while (isTaken(x + step) && step < 10) step += 0.8;
  return [x + step, y];
}

const WALL = { thickness: 0.15, height: 1 };

/** Builds a wall from one point of the floor to another. */
export function placeWall(editor: UniverseEditor, from: Point, to: Point): void {
  const { middle, length, yaw } = wallBetween(from, to);
  if (length < 0.01) return;
  edit(editor, 'add', (universe) =>
    add(universe, 'models', [
      {
        id: freeId(universe, 'wall'),
        shape: 'box',
        // The wall is longer by half its thickness at each end, so that corners close.
        size: [rounded(length + WALL.thickness), WALL.thickness, WALL.height],
        pose: [...middle, WALL.height / 2, 0, 0, yaw],
        color: '#e9e4da',
        ...(universe.ceiling ? { to_ceiling: true } : {}),
      },
    ]),
  );
}

const selected = (editor: UniverseEditor) => editor.store.getState().selection;

export function duplicateSelected(editor: UniverseEditor): void {
  const { grid } = editor.store.getState();
  const step = Math.max(grid, 0.5);
  edit(editor, 'duplicate', (universe) => duplicate(universe, selected(editor), [step, step]));
}

/** Deletes the selected waypoint, or the selected things if there is none. */
export function deleteSelected(editor: UniverseEditor): void {
  const { waypoint, selection } = editor.store.getState();
  const [key] = selection;
  if (waypoint !== null && key !== undefined) {
    edit(editor, 'way', (universe) => removeWaypoint(universe, key, waypoint));
    select(editor, [key], null);
  } else edit(editor, 'delete', (universe) => remove(universe, selection));
}

/** Moves the selection by grid steps; repeated presses of a key are merged into one undo step. */
export function nudge(editor: UniverseEditor, along: number, aside: number, up: number, factor = 1): void {
  const { grid, selection, waypoint } = editor.store.getState();
  const step = (grid || 0.01) * factor;
  const [fx, fy] = editor.view?.forward() ?? [1, 0];
  const dx = (fx * along - fy * aside) * step;
  const dy = (fy * along + fx * aside) * step;
  const [key] = selection;
  const mergeKey = `nudge ${selection.join()} ${waypoint ?? ''}`;
  edit(
    editor,
    'move',
    (universe) => {
      const actor = key === undefined ? undefined : thingOf(universe, key);
      const point = actor && hasPath(actor) && waypoint !== null ? actor.path[waypoint] : undefined;
      if (key !== undefined && point && waypoint !== null) {
        return setWaypoint(universe, key, waypoint, [point[0] + dx, point[1] + dy]);
      }
      return move(universe, selection, [dx, dy, up * step]);
    },
    { mergeKey },
  );
}

export function turnSelected(editor: UniverseEditor, angle: number): void {
  const { selection } = editor.store.getState();
  edit(
    editor,
    'turn',
    (universe) => {
      const things = universe.things.filter(({ key }) => selection.includes(key));
      return turn(universe, selection, angle, middleOf(things));
    },
    { mergeKey: `turn ${selection.join()}` },
  );
}

/** Sets the size of a thing; a thing on the floor stays on the floor. */
export function resize(
  editor: UniverseEditor,
  key: string,
  size: readonly number[],
  mergeKey?: string,
): void {
  edit(
    editor,
    'size',
    (universe) => {
      const thing = thingOf(universe, key);
      if (thing?.section !== 'models') return { ops: [] };
      const [x, y, z, roll, pitch, yaw] = thing.pose;
      const sized = setField(universe, key, 'size', [...size]);
      const isStanding = Math.abs(z - standingHeight(thing)) < 2e-3 && roll === 0 && pitch === 0;
      if (!isStanding || sized.ops.length === 0) return sized;
      const height = standingHeight({ shape: thing.shape, size });
      const stood = setField(universe, key, 'pose', [x, y, height, roll, pitch, yaw]);
      return { ops: [...sized.ops, ...stood.ops] };
    },
    mergeKey === undefined ? {} : { mergeKey },
  );
}

/** Adds a waypoint or a corner half way between one and the next one. */
export function extendWay(editor: UniverseEditor, key: string, after: number): void {
  edit(editor, 'way', (universe) => {
    const thing = thingOf(universe, key);
    if (!thing || !hasPath(thing)) return { ops: [] };
    const { path } = thing;
    const isClosed = thing.section === 'areas' || thing.loop;
    const [x, y] = path[after] ?? [0, 0];
    const next = path[after + 1] ?? (isClosed ? path[0] : undefined);
    const isLast = !next || path.length === 1;
    const point: Point = isLast ? [x + 1, y] : [(x + next[0]) / 2, (y + next[1]) / 2];
    return addWaypoint(universe, key, after, point);
  });
  select(editor, [key], after + 1);
}
