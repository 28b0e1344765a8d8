import { create } from 'zustand';
import type { LiveKey } from '@/store/project/live';
import { runsOf } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import { hidePaths, hueOf, showPaths, type ShownPath } from '@/store/session/trace/shownPaths';
import { extent, lookAt, lookNow } from '../looking';
import { useSource } from '../source';
import { useMoment } from '../store';
import { Course } from './course';
import { differences, differingBlocks, type Difference, type StatusThere } from './differences';
import { courseOf, partedAt, piecesFrom } from './lines';
import { nameOf } from './runNames';

interface Comparing {
  /** The run with which the shown one is compared; null: with none. */
  readonly other: string | null;
  /** When both part, in s. */
  readonly partedAt: number;
  /** Where the other run ends, in s. */
  readonly otherEnd: number;
  /**
   * What is known of the shown moment: `one` until both ticked alone; after the end of
   * the other run `beyond`, after that of the shown one `over`.
   */
  readonly state: 'reading' | 'one' | 'beyond' | 'over' | 'shown';
  readonly rows: readonly Difference[];
  /** The status in the other run, of each block that differs. */
  readonly blocks: ReadonlyMap<LiveKey, StatusThere>;
  readonly failure: string;
}

/** A run that another one replaced ends with its halt, in which all its blocks are idle. */
const BEFORE_END_S = 0.1;
/** Times of one moment differ by less: half a step of the world. */
const SAME_S = 0.002;
const NO_BLOCKS: ReadonlyMap<LiveKey, StatusThere> = new Map();
const none: Comparing = {
  other: null,
  partedAt: 0,
  otherEnd: 0,
  state: 'reading',
  rows: [],
  blocks: NO_BLOCKS,
  failure: '',
};

/** The comparison of the shown run with another one, at the moment at which the user looks. */
export const useComparing = create<Comparing>(() => none);

export const isComparing = (): boolean => useComparing.getState().other !== null;

interface Courses {
  readonly here: Course;
  readonly there: Course;
  readonly names: readonly [string, string];
  readonly stops: readonly (() => void)[];
}

let courses: Courses | null = null;
let isAsking = false;
let isOutdated = false;
let isDrawing = false;
let isChanged = false;

/** Returns the runs with which the shown one can be compared, the last one first: all that have a past in common. */
export function comparableRuns(): string[] {
  const shown = extent()?.run;
  if (shown === undefined || useSource.getState().kept !== null) return [];
  const { segments, branches } = useSessionStore.getState();
  const own = courseOf(shown, branches);
  const others = runsOf(segments).filter((run) => run !== shown);
  return others.filter((run) => partedAt(own, courseOf(run, branches)) !== null).reverse();
}

export const canCompare = (): boolean => comparableRuns().length > 0;

/** Compares the shown run with another one; at the present, at the last moment that both have. */
export function compareWith(other: string): void {
  const shown = extent();
  if (!shown || !comparableRuns().includes(other)) return;
  endComparing();
  const session = useSessionStore.getState();
  const own = courseOf(shown.run, session.branches);
  const there = courseOf(other, session.branches);
  const parted = partedAt(own, there) ?? 0;
  const changed = (failure: string) => {
    if (failure !== '') useComparing.setState({ failure });
    refresh();
  };
  courses = {
    here: new Course(piecesFrom(own, parted), changed),
    there: new Course(piecesFrom(there, parted), changed),
    names: [nameOf(shown.run, session), nameOf(other, session)],
    stops: [
      useMoment.subscribe((now, before) => {
        if (now.t === null) endComparing();
        else if (now.overview !== before.overview) refresh();
        else if (now.shown !== before.shown) void compare();
      }),
      useSessionStore.subscribe((now, before) => {
        if (now.segments === before.segments) return;
        if (!runsOf(now.segments).includes(other)) endComparing();
        else useComparing.setState({ otherEnd: courses?.there.end() ?? 0 });
      }),
    ],
  };
  const otherEnd = courses.there.end();
  useComparing.setState({ ...none, other, partedAt: parted, otherEnd });
  if (useMoment.getState().t === null) lookAt(Math.max(Math.min(shown.to, otherEnd - BEFORE_END_S), parted));
  refresh();
}

/** Compares the shown run with the one that it continues, or else with the last other one. */
export function compareSomething(): void {
  const shown = extent()?.run;
  const runs = comparableRuns();
  const parent = useSessionStore.getState().branches.find(({ run }) => run === shown)?.parent;
  const other = runs.find((run) => run === parent) ?? runs[0];
  if (other !== undefined) compareWith(other);
}

/** Ends the comparison; the moment stays. */
export function endComparing(): void {
  const ended = courses;
  courses = null;
  for (const stop of ended?.stops ?? []) stop();
  ended?.here.close();
  ended?.there.close();
  hidePaths('compare');
  if (isComparing()) useComparing.setState(none);
}

/** Leaves what is open: the comparison first, then the past. */
export function leaveMoment(): void {
  if (isComparing()) endComparing();
  else lookNow();
}

function refresh(): void {
  void compare();
  void draw();
}

/** Compares the statuses of the shown moment; while an answer is awaited, only the newest moment is kept. */
async function compare(): Promise<void> {
  isOutdated = true;
  if (isAsking) return;
  isAsking = true;
  try {
    while (isOutdated) {
      isOutdated = false;
      await compareShown();
    }
  } finally {
    isAsking = false;
  }
}

async function compareShown(): Promise<void> {
  const now = courses;
  const { shown, tree } = useMoment.getState();
  if (!now || !shown) return;
  const otherEnd = now.there.end();
  const nothing = { rows: [], blocks: NO_BLOCKS, otherEnd };
  now.here.want(shown.t);
  now.there.want(shown.t);
  const parted = useComparing.getState().partedAt;
  // A part of a course shows nothing before its first tick: until both have ticked, both show the common past.
  const isCommon = (tickT: number | null) => tickT === null || tickT < parted + SAME_S;
  if (isCommon(shown.tickT)) return useComparing.setState({ ...nothing, state: 'one' });
  if (shown.halted) return useComparing.setState({ ...nothing, state: 'over' });
  if (shown.t > otherEnd) return useComparing.setState({ ...nothing, state: 'beyond' });
  const there = await now.there.at(shown.t);
  if (now !== courses) return;
  if (!there) return useComparing.setState({ ...nothing, state: 'reading' });
  if (isCommon(there.tickT)) return useComparing.setState({ ...nothing, state: 'one' });
  if (there.isHalted) return useComparing.setState({ ...nothing, state: 'beyond' });
  const here = { nodes: tree, statuses: shown.statuses, flashes: shown.flashes };
  const rows = differences(here, there);
  const blocks = rows.length > 0 ? differingBlocks(here, there) : NO_BLOCKS;
  useComparing.setState({ state: 'shown', rows, blocks, otherEnd });
}

/** Draws the paths of both runs, as far as they were read. */
async function draw(): Promise<void> {
  isChanged = true;
  if (isDrawing) return;
  isDrawing = true;
  try {
    while (isChanged) {
      isChanged = false;
      const now = courses;
      if (!now) return;
      const [here, there] = await Promise.all([now.here.paths(), now.there.paths()]);
      if (now === courses)
        showPaths('compare', [pathOf(1, now.names[0], here), pathOf(2, now.names[1], there)]);
    }
  } finally {
    isDrawing = false;
  }
}

/** The first path is that of the shown run. */
const pathOf = (number: 1 | 2, name: string, lines: readonly Float32Array[]): ShownPath => ({
  label: String(number),
  name,
  hue: hueOf(number),
  isDashed: number === 2,
  labelAt: 'moment',
  lines,
});
