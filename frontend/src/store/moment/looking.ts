import { useProjectStore } from '@/store/project';
import { usePastLive } from '@/store/project/live';
import { earlierSource, runsOf } from '@/store/recording/liveSource';
import { RecordedRun, type EngineLink } from '@/store/recording/recordedRun';
import type { Answers, Ask, FromEngine } from '@/store/recording/engine';
import type { ProfileSum } from '@/store/recording/profile';
import type { Story } from '@/store/recording/story';
import type { RecordedTimeline } from '@/store/recording/timelineOf';
import {
  recordedTime,
  type Changes,
  type EntryName,
  type Moment,
  type Overview,
} from '@/store/recording/types';
import type { RecordingSource, WriteAt } from '@/store/recording/types';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import type { LogLine } from '@/store/session/types';
import { identified, recordedTrees } from './recordedTrees';
import { consoleOf, linesUntil, rowsOf, usePastSession } from './session';
import { markedRange, nextMoment, noRange, useRange } from './range';
import { isPresentRun, ofSession, useSource, type Kept } from './source';
import { atPresent, useMoment } from './store';
import { showPresentTrail, showTrail } from './trail';
import { showPresentWorld, showWorld } from './world';

/** The length of the run that can be looked at, in s; null without a recording. */
export interface Extent {
  readonly run: string;
  readonly from: number;
  readonly to: number;
}

/** The pause between two readings of a timeline, which costs the worker time. */
const TIMELINE_EVERY_MS = 1000;

let recorded: RecordedRun | null = null;
let lines: readonly LogLine[] = [];
let linesOf: Overview | null = null;
let isAsking = false;
let isOutdated = false;
let run = '';
let stopPresent: () => void = () => undefined;

function workerLink(): EngineLink {
  const worker = new Worker(new URL('../recording/recording.worker.ts', import.meta.url), { type: 'module' });
  const link: EngineLink = {
    post: (message) => worker.postMessage(message),
    onMessage: () => undefined,
  };
  worker.onmessage = ({ data }: MessageEvent<FromEngine>) => link.onMessage(data);
  return link;
}

let makeLink = workerLink;

/** Replaces the worker, for tests without workers. */
export function setEngineLink(make: () => EngineLink): void {
  makeLink = make;
  recorded?.end();
  recorded = null;
}

/** Returns a new engine for the recording of another run. */
export const newLink = (): EngineLink => makeLink();

export function extent(): Extent | null {
  const segments = useSource.getState().source.segments();
  const first = segments[0];
  if (!first) return null;
  const from = Math.min(...segments.map(({ from_t }) => from_t));
  const to = Math.max(...segments.map(({ to_t }) => to_t));
  return { run: first.run, from, to };
}

/** Shows a moment of the run in all views. */
export function lookAt(t: number, tick: number | null = null): void {
  const now = extent();
  if (!now) return;
  const isFirst = useMoment.getState().t === null;
  if (run !== '' && run !== now.run) useRange.setState(noRange);
  run = now.run;
  useMoment.setState({
    t: recordedTime(Math.min(Math.max(t, now.from), now.to)),
    tick,
    ...(isFirst ? { failure: '' } : {}),
  });
  theRun().want(t);
  void refresh();
}

/** Shows a moment of the session's last run, also while another run is open. */
export function lookAtPresentRun(t: number): void {
  if (!isPresentRun(useSource.getState())) lookNow();
  lookAt(t);
}

/** Opens a kept run at a moment, or at its begin. */
export function openKept(source: RecordingSource, kept: Kept, t: number | null = null): void {
  lookNow();
  change({ source, kept });
  const begin = extent();
  if (begin) lookAt(t ?? begin.from);
}

/** Opens a run of the session at a moment, or at its begin; one that is not there any more is left out. */
export function openRun(name: string, t: number | null = null): void {
  const runs = runsOf(useSessionStore.getState().segments);
  if (!runs.includes(name)) return;
  lookNow();
  if (name !== runs.at(-1)) change({ source: earlierSource(name), kept: null });
  const begin = extent();
  if (begin) lookAt(t ?? begin.from);
}

/** Returns to the present, and closes a kept run. */
export function lookNow(): void {
  if (useMoment.getState().t === null) return;
  const { speed } = useMoment.getState();
  useMoment.setState({ ...atPresent, speed, overview: useMoment.getState().overview });
  recorded?.want(null);
  if (!isPresentRun(useSource.getState())) change(ofSession);
  showPresentWorld();
  showPresentTrail();
}

function change(source: typeof ofSession): void {
  recorded?.end();
  stopPresent();
  recorded = null;
  showPresentTrail();
  useSource.setState(source);
  useRange.setState(noRange);
  useMoment.setState({ overview: null, failure: '' });
}

/** Goes some ticks forth, or back if negative; at the present, back from its end. */
export async function goTicks(by: number): Promise<void> {
  const begin = await beginning();
  if (begin === null) return;
  const found = await theRun().ask({ what: 'tick', ...begin, by });
  if (found) lookAt(found.t, found.tick);
}

/** Goes some seconds forth, or back if negative. */
export function goSeconds(by: number): void {
  const begin = useMoment.getState().t ?? extent()?.to;
  if (begin !== undefined) lookAt(begin + by);
}

/** Goes to the next (1) or previous (-1) tick in which a node changed or returned something. */
export async function goToChange(uid: number, direction: 1 | -1): Promise<boolean> {
  const begin = await beginning();
  if (begin === null) return false;
  const found = await theRun().ask({ what: 'change', uid, ...begin, direction });
  if (found) lookAt(found.t, found.tick);
  return found !== null;
}

/** Returns the moment from which to continue: at the present, the end of the run, once that was read. */
async function beginning(): Promise<{ t: number; tick: number | null } | null> {
  const { t, tick } = useMoment.getState();
  if (t !== null) return { t, tick };
  const end = extent()?.to;
  if (end === undefined) return null;
  lookAt(end);
  return new Promise((resolve) => {
    const stop = useMoment.subscribe((now) => {
      if (now.t !== null && now.shown === null) return;
      stop();
      resolve(now.t === null ? null : { t: now.t, tick: now.tick });
    });
  });
}

/** Returns what changed between two moments; null while one of them is not read. */
export async function changesBetween(from: number, to: number): Promise<Changes | null> {
  const run = theRun();
  run.want(useMoment.getState().t ?? to);
  const changes = await run.ask({ what: 'changes', from, to });
  // The part with the second moment is read first.
  if (changes === null && useMoment.getState().t === null) run.want(from);
  return changes;
}

/** Returns the times of nodes in a part of the recording; null while it is not read. */
export async function profileBetween(from: number, to: number): Promise<ProfileSum | null> {
  const run = theRun();
  run.want(useMoment.getState().t ?? to);
  const sum = await run.ask({ what: 'profile', from, to });
  if (sum === null && useMoment.getState().t === null) run.want(from);
  return sum;
}

/**
 * Returns the story of the tree until the shown moment, or until now; null if no tree ran.
 *
 * @throws Error: the recording cannot be read.
 */
export async function storyUntilNow(): Promise<Story | null> {
  const { t: shown, tick } = useMoment.getState();
  const t = shown ?? extent()?.to;
  if (t === undefined) return null;
  const now = await readUntil(t);
  const story = await now.ask({ what: 'story', t, tick });
  if (useMoment.getState().t === null) now.want(null);
  return story;
}

async function readUntil(t: number): Promise<RecordedRun> {
  const now = theRun();
  now.want(t);
  await new Promise<void>((resolve, reject) => {
    const stop = useMoment.subscribe(() => look());
    const look = () => {
      const { failure } = useMoment.getState();
      if (!now.hasUntil(t) && failure === '' && recorded === now) return;
      stop();
      if (failure === '') resolve();
      else reject(new Error(failure));
    };
    look();
  });
  return now;
}

/** Asks the recording that is open; undefined if another one is open when the answer comes. */
export async function askShown<K extends keyof Answers>(
  ask: Ask & { what: K },
): Promise<Answers[K] | undefined> {
  const now = theRun();
  const answer = await now.ask<K>(ask);
  return now === recorded ? answer : undefined;
}

/** Goes to the last fault of the present run with a message; returns whether it is recorded. */
export async function goToFault(message: string): Promise<boolean> {
  if (!isPresentRun(useSource.getState())) lookNow();
  const end = extent()?.to;
  if (end === undefined) return false;
  const { overview } = await readUntil(end);
  const fault = overview?.faults.findLast((each) => each.message === message);
  if (fault) lookAt(fault.t);
  else if (useMoment.getState().t === null) theRun().want(null);
  return fault !== undefined;
}

/**
 * Calls back with the writes of a key, the last ones first, now and when more of the recording was read; returns
 * a function that stops it.
 */
export function followWrites(key: EntryName, show: (writes: readonly WriteAt[]) => void): () => void {
  let isOver = false;
  const ask = async () => {
    const end = extent()?.to;
    if (end === undefined) return;
    const now = theRun();
    now.want(useMoment.getState().t ?? end);
    const writes = await now.ask({ what: 'writes', ...key });
    if (!isOver && now === recorded) show(writes ?? []);
  };
  const stop = useMoment.subscribe((now, before) => {
    if (now.overview !== before.overview || now.t !== before.t) void ask();
  });
  void ask();
  return () => {
    isOver = true;
    stop();
    if (useMoment.getState().t === null) recorded?.want(null);
  };
}

/**
 * Calls back when another run is opened, and with the timeline of an open run when more of it was read; returns
 * a function that stops it.
 */
export function followTimeline(
  show: (timeline: RecordedTimeline | null, isPresent: boolean) => void,
): () => void {
  let isOver = false;
  let readOf: Overview | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const ask = async () => {
    timer = undefined;
    const { overview } = useMoment.getState();
    if (isOver || overview === null || overview === readOf) return;
    readOf = overview;
    const now = theRun();
    const timeline = await now.ask({ what: 'timeline' });
    if (!isOver && now === recorded && timeline) show(timeline, false);
  };
  const look = () => {
    const pauseMs = readOf === null ? 0 : TIMELINE_EVERY_MS;
    if (!isPresentRun(useSource.getState())) timer ??= setTimeout(() => void ask(), pauseMs);
  };
  const begin = () => {
    readOf = null;
    show(null, isPresentRun(useSource.getState()));
    look();
  };
  const stops = [
    useSource.subscribe(begin),
    useMoment.subscribe((now, before) => {
      if (now.overview !== before.overview) look();
    }),
  ];
  begin();
  return () => {
    isOver = true;
    clearTimeout(timer);
    for (const stop of stops) stop();
  };
}

export function setPlaying(isPlaying: boolean): void {
  const { t } = useMoment.getState();
  const now = extent();
  if (!now || useMoment.getState().isPlaying === isPlaying) return;
  // At the end, playing begins at the start, as in any player.
  if (isPlaying && (t === null || t >= now.to)) lookAt(now.from);
  useMoment.setState({ isPlaying });
  if (isPlaying) requestAnimationFrame((first) => play(first));
}

function play(last: number): void {
  requestAnimationFrame((now) => {
    const { isPlaying, t, speed } = useMoment.getState();
    const end = extent()?.to;
    if (!isPlaying || t === null || end === undefined) return;
    const range = useRange.getState();
    const loop = range.isLooping ? markedRange(range) : null;
    const next = nextMoment(t, ((now - last) / 1000) * speed, loop);
    lookAt(next);
    if (next >= end && !loop) useMoment.setState({ isPlaying: false });
    else play(now);
  });
}

function theRun(): RecordedRun {
  if (recorded) return recorded;
  const { source, kept } = useSource.getState();
  const link = makeLink();
  // Segments of a session do not hold the meshes and textures of its world; a kept run does.
  if (!kept && !isPresentRun({ source, kept }))
    stopPresent = frames.listen('scene', ({ name, meshes, textures }) =>
      link.post({ kind: 'present', scene: { name, meshes, textures } }),
    );
  recorded = new RecordedRun(source, link, onOverview, (failure) => useMoment.setState({ failure }));
  return recorded;
}

function onOverview(overview: Overview): void {
  useMoment.setState({ overview });
  void refresh();
}

/** Asks for the wanted moment; while an answer is awaited, only the newest wish is kept. */
async function refresh(): Promise<void> {
  if (isAsking) {
    isOutdated = true;
    return;
  }
  isAsking = true;
  try {
    do {
      isOutdated = false;
      const { t, tick, shown } = useMoment.getState();
      if (t === null) return;
      const known = shown ? shown.generation : -1;
      const scene = shown ? shown.sceneId : -1;
      const asked = theRun();
      const moment = await asked.ask({ what: 'moment', t, tick, known, scene });
      if (asked !== recorded) {
        // It belongs to a run that is not shown any more.
        isOutdated = true;
        continue;
      }
      if (moment && useMoment.getState().t !== null) show(moment);
    } while (isOutdated);
  } finally {
    isAsking = false;
  }
}

function show(moment: Moment): void {
  const before = useMoment.getState();
  const tree = moment.tree ? identified(moment.tree) : before.tree;
  const trees = moment.tree ? recordedTrees(tree, moment.files ?? {}) : before.trees;
  if (before.overview !== linesOf && before.overview) {
    linesOf = before.overview;
    lines = consoleOf(before.overview);
  }
  const live = usePastLive.getState();
  if (moment.tree || !before.shown) live.setTree(tree);
  const faults = (before.overview?.faults ?? []).filter((fault) => fault.t <= moment.t);
  live.setMoment({
    statuses: moment.statuses,
    flashed: moment.flashes,
    halted: moment.halted,
    faults: faults.map(({ uid, message }) => [uid, message]),
  });
  usePastSession.setState(
    {
      ...useSessionStore.getState(),
      // Lists that are as before stay the same objects, so that views of them are not drawn again.
      tree: same(usePastSession.getState().tree, tree),
      blackboard: rowsOf(moment, tree),
      logs: same(usePastSession.getState().logs, linesUntil(lines, moment.t)),
      simTime: moment.t,
      tick: moment.tick,
      faults: [],
      finished: null,
    },
    true,
  );
  const isSame = moment.scene === null && moment.sceneId === before.shown?.sceneId;
  const scene = isSame ? before.scene : moment.scene;
  useMoment.setState({ shown: moment, tree, trees, scene });
  const isPresent = isPresentRun(useSource.getState());
  showWorld(moment, isPresent ? null : scene);
  const run = theRun();
  void showTrail(moment.t, before.overview, isPresent, () => run.ask({ what: 'trail' }));
}

/** Returns the list from before if it has the same items, else a copy of the new one. */
function same<T>(before: T[], now: readonly T[]): T[] {
  const isSame = before.length === now.length && before.every((item, at) => item === now[at]);
  return isSame ? before : [...now];
}

/** Returns to the present when the run is gone, and when the user edits, since edits belong to the present. */
export function followPresent(): () => void {
  const stops = [
    useSessionStore.subscribe((now, before) => {
      if (now.segments !== before.segments && extent()?.run !== run) lookNow();
    }),
    useProjectStore.subscribe((now, before) => {
      if (now.changeCounter !== before.changeCounter || now.projectId !== before.projectId) lookNow();
    }),
  ];
  return () => {
    stops.forEach((stop) => stop());
    lookNow();
    recorded?.end();
    recorded = null;
    useMoment.setState(atPresent);
  };
}
