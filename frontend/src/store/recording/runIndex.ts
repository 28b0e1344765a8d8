import type { NodeStatus, Scene, TopicInfo } from '@/generated/messages';
import { moved } from './posesAt';
import { profileSum, type ProfileSum } from './profile';
import { sceneOf } from './sceneOf';
import type { PresentScene } from './sceneParts';
import type { Read } from './segmentReader';
import { messagesAt, seriesOf, topicsOf, type FieldName, type MessageAt } from './topics/topicQueries';
import type { RecordedSeries, SeriesRange } from './topics/topicQueries';
import { SegmentIndex, type State } from './segmentIndex';
import type { TickStep } from './steps';
import { storyUntil, type Story } from './story';
import { TimelineReader, type RecordedTimeline } from './timelineOf';
import { trailOf } from './trailOf';
import type {
  Changes,
  EntryAt,
  EntryName,
  FlagMark,
  Mark,
  Moment,
  Overview,
  PictureAt,
  ScanAt,
  TickAt,
  WriteAt,
} from './types';

/** The bytes of pictures that are kept; beyond them, those of the oldest segments go. */
const MOST_PICTURE_BYTES = 128 << 20;
/** The memory of messages of topics; beyond it, the largest topics are thinned. */
const MOST_TOPIC_BYTES = 128 << 20;
const MOST_LINES = 20_000;
const MOST_MARKS = 1000;
const MOST_WRITES = 500;

/** Returns the flags that are set at the end of what was read. */
function flagsOf(segments: readonly SegmentIndex[]): FlagMark[] {
  const last = new Map(segments.flatMap(({ flags }) => flags.map((flag) => [flag.id, flag] as const)));
  return [...last.values()].filter(({ text }) => text !== '').slice(-MOST_MARKS);
}

/** All parts of a recording that were read, with the state at each moment. */
export class RunIndex {
  private readonly segments = new Map<number, SegmentIndex>();
  private readonly timelineReader = new TimelineReader();

  constructor(
    readonly run: string,
    private readonly scenes = new Scenes(),
  ) {}

  /** Returns an empty index for other parts of the run; both number the worlds alike. */
  beside(): RunIndex {
    return new RunIndex(this.run, this.scenes);
  }

  /** Takes the world of the present run, whose parts a recording of the session does not hold. */
  takePresent(scene: PresentScene | null): void {
    this.scenes.takePresent(scene);
  }

  segment(number: number, from: number): SegmentIndex {
    let found = this.segments.get(number);
    if (!found) this.segments.set(number, (found = new SegmentIndex(number, from, this.scenes.parts)));
    return found;
  }

  drop(number: number): void {
    this.segments.delete(number);
  }

  overview(): Overview {
    const all = this.inOrder();
    const root: [number, NodeStatus][] = [];
    for (const segment of all) {
      let uid = 0;
      for (const step of segment.steps) {
        if (step.kind === 'tree') uid = step.nodes.find(({ parent }) => parent === 0)?.uid ?? 0;
        if (step.kind === 'tree') push(root, step.t, segment.stateAt(step.t).statuses.get(uid) ?? 'IDLE');
        if (step.kind !== 'tick') continue;
        const changed = step.changed.find(([each]) => each === uid);
        if (changed) push(root, step.t, changed[1]);
      }
    }
    return {
      run: this.run,
      read: all.map(({ from, until, to }) => [from, Math.max(until, to)] as const),
      root,
      marks: [...this.atTicks(all.flatMap(({ marks }) => marks).slice(-MOST_MARKS)), ...flagsOf(all)],
      lines: all.flatMap(({ lines }) => lines).slice(-MOST_LINES),
      faults: all.flatMap(({ faults }) => faults).slice(-MOST_MARKS),
    };
  }

  /** Moves the marks within a tick to the moment that shows the tick, if it ended. */
  private atTicks(marks: readonly Mark[]): readonly Mark[] {
    if (!marks.some(({ tick }) => tick !== undefined)) return marks;
    const times = new Map(this.ticks().map(({ number, t }) => [number, t]));
    return marks.map((mark) => ({ ...mark, t: times.get(mark.tick ?? -1) ?? mark.t }));
  }

  /**
   * Returns everything at a time; null if the part of the recording with it is not read.
   *
   * @param known the generation of the tree that the asker has.
   * @param tick the last of several ticks of that time; null: all of them.
   */
  momentAt(t: number, known = -1, tick: number | null = null, knownScene = -1): Moment | null {
    const segment = this.at(t);
    if (!segment) return null;
    const state = segment.stateAt(t, tick);
    const last = state.tick;
    const sceneId = this.scenes.idOf(lastOf(segment.scenes, t));
    return {
      t,
      tick: state.number,
      tickT: last?.t ?? null,
      durationMs: last?.durationMs ?? null,
      generation: state.generation,
      tree: state.generation === known ? null : state.nodes,
      files: state.generation === known ? null : state.files,
      statuses: [...state.statuses],
      flashes: last?.flashed ?? [],
      was: state.was,
      forced: last?.forced ?? [],
      halted: state.halted,
      entries: [...state.entries].map(([id, entry]): EntryAt => ({
        ...entry,
        ...this.since(segment, state, id),
      })),
      scene: sceneId === knownScene ? null : this.scenes.of(sceneId),
      sceneId,
      poses: segment.posesAt(t),
      scan: scanOf(lastOf(segment.scans, t)),
      pictures: [...segment.pictures.values()].flatMap((list) => pictureOf(lastOf(list, t)) ?? []),
    };
  }

  /** Returns the n-th tick after a moment, or before it if n is negative; null outside of the parts that were read. */
  tickFrom(t: number, n: number, tick: number | null = null): TickAt | null {
    const all = this.ticks();
    return placed(all[lastUntil(all, t, tick) + n]);
  }

  /** Returns the next (1) or previous (-1) tick in which the node changed or returned something. */
  changeFrom(uid: number, t: number, direction: 1 | -1, tick: number | null = null): TickAt | null {
    const all = this.ticks();
    const now = lastUntil(all, t, tick);
    const has = ({ changed, flashed }: TickStep) => [...changed, ...flashed].some(([each]) => each === uid);
    return placed(
      direction > 0 ? all.slice(now + 1).find(has) : all.slice(0, Math.max(now, 0)).findLast(has),
    );
  }

  /** Returns what changed from one time to another; null if one of them is not read. */
  changes(from: number, to: number): Changes | null {
    const [before, after] = [this.at(from), this.at(to)];
    if (!before || !after) return null;
    const [a, b] = [before.stateAt(from), after.stateAt(to)];
    const uids = b.nodes.map(({ uid, path }) => ({ uid, path }));
    const statuses = uids
      .map(({ uid, path }) => ({
        uid,
        path,
        from: a.statuses.get(uid) ?? 'IDLE',
        to: b.statuses.get(uid) ?? 'IDLE',
      }))
      .filter((each) => each.from !== each.to);
    const ids = new Set([...a.entries.keys(), ...b.entries.keys()]);
    const entries = [...ids].flatMap((id) => {
      const [old, now] = [a.entries.get(id), b.entries.get(id)];
      const { scope = '', key = '' } = old ?? now ?? {};
      if (JSON.stringify(old?.value) === JSON.stringify(now?.value)) return [];
      const { since } = this.since(after, b, id);
      return [{ scope, key, from: old?.value, to: now?.value, since }];
    });
    return { statuses, entries, poses: moved(before.posesAt(from), after.posesAt(to)) };
  }

  /** Returns the times of nodes from one time to another; null while a part between them is not read. */
  profile(from: number, to: number): ProfileSum | null {
    const all = this.inOrder().filter((each) => each.from < to && Math.max(each.until, each.to) > from);
    const isWhole = all.every(({ number }, at) => at === 0 || number === (all[at - 1]?.number ?? 0) + 1);
    if (!isWhole || !this.at(from) || !this.at(to)) return null;
    const trees = new Map(
      all.flatMap(({ steps }) =>
        steps.flatMap((step) => (step.kind === 'tree' ? [[step.generation, step.nodes] as const] : [])),
      ),
    );
    const rows = all.flatMap(({ profile }) => profile);
    return profileSum(rows, from, to, (generation) => trees.get(generation) ?? []);
  }

  /** Returns the path of the first robot, as far as it was read. */
  trail(): Float32Array {
    const [first] = this.robots();
    return first ? this.pathOf(first[1]) : new Float32Array();
  }

  /** Returns the paths of all robots by their names, as far as they were read. */
  trails(): Record<string, Float32Array> {
    return Object.fromEntries([...this.robots()].map(([body, id]) => [body, this.pathOf(id)]));
  }

  /** Returns the first object of each robot, which is its base. */
  private robots(): Map<string, number> {
    const scene = this.scenes.of(this.scenes.idOf(this.inOrder().flatMap(({ scenes }) => scenes)[0] ?? null));
    const robots = new Map<string, number>();
    for (const { kind, body, id } of scene?.objects ?? [])
      if (kind === 'robot' && !robots.has(body)) robots.set(body, id);
    return robots;
  }

  private pathOf(id: number): Float32Array {
    return trailOf(
      this.inOrder().flatMap(({ poses }) => poses),
      id,
    );
  }

  /** Returns the statuses of all nodes over time, as far as they were read. */
  timeline(): RecordedTimeline | null {
    return this.timelineReader.read(this.inOrder());
  }

  /** Returns the topics of robot and project that were read. */
  topics(): TopicInfo[] {
    return topicsOf(this.inOrder());
  }

  /** Returns the last messages of some topics until a moment; null if the part with it is not read. */
  messagesAt(topics: readonly string[], t: number): MessageAt[] | null {
    const last = this.at(t);
    return last && messagesAt(this.inOrder().slice(0, this.inOrder().indexOf(last) + 1), topics, t);
  }

  /** Returns the numbers of some fields over time, as far as they were read and decoded. */
  series(fields: readonly FieldName[], range: SeriesRange): RecordedSeries {
    return seriesOf(this.inOrder(), fields, range);
  }

  /** Returns the last writes of a key in all parts that were read, the last one first. */
  writesOf(name: EntryName): WriteAt[] {
    const all = this.inOrder().toReversed();
    const writes: WriteAt[] = [];
    for (const segment of all) {
      if (writes.length < MOST_WRITES) writes.push(...segment.writesOf(name));
    }
    return writes.slice(0, MOST_WRITES);
  }

  /** Returns the story of a moment's tree until then, from the parts that were read without a gap. */
  storyUntil(t: number, tick: number | null = null): Story | null {
    return storyUntil(this.inOrder(), t, tick);
  }

  /** Drops pictures of the oldest segments, and some messages of topics, until the others fit. */
  trim(): void {
    const all = this.inOrder();
    for (let sum = bytesOf(all); sum > MOST_TOPIC_BYTES; sum = bytesOf(all))
      all.reduce((most, each) => (each.topics.bytes > most.topics.bytes ? each : most)).topics.thin();
    let bytes = 0;
    for (const segment of all.toReversed()) {
      for (const list of segment.pictures.values()) for (const { data } of list) bytes += data.length;
      if (bytes > MOST_PICTURE_BYTES) segment.pictures.clear();
    }
  }

  private inOrder(): SegmentIndex[] {
    return [...this.segments.values()].sort((a, b) => a.number - b.number);
  }

  /** Returns the segment that contains a time, if that part of it was read. */
  private at(t: number): SegmentIndex | null {
    const found = this.inOrder().findLast(({ from }) => from <= t);
    if (!found || found.until < found.from) return null;
    // Between the last message of a segment and the first of the next, nothing happened.
    const isBetween = found.isWhole && this.segments.has(found.number + 1);
    return isBetween || t <= Math.max(found.until, found.to) ? found : null;
  }

  private ticks(): TickStep[] {
    return this.inOrder().flatMap(({ steps }) => steps.filter((step) => step.kind === 'tick'));
  }

  /** Returns since when an entry has its value, and who wrote it, also from earlier segments. */
  private since(segment: SegmentIndex, state: State, id: string): Pick<EntryAt, 'since' | 'writer'> {
    const own = state.written.get(id);
    if (own) return { since: own.t, writer: own.writer };
    for (let earlier: SegmentIndex | undefined = segment; earlier;) {
      const found = earlier.lastWrite(id, earlier === segment ? state.last : Infinity);
      if (found)
        return found.isRemoved ? { since: null, writer: null } : { since: found.t, writer: found.writer };
      earlier = this.segments.get(earlier.number - 1);
    }
    return { since: null, writer: null };
  }
}

/** The different worlds of a recording: each segment has its world again. */
class Scenes {
  readonly parts = new Map<string, Uint8Array>();
  private present: PresentScene | null = null;
  private known: { readonly bytes: Uint8Array | null; readonly scene: Scene | null }[] = [];
  private ids = new WeakMap<Read, number>();

  /** The worlds are put together again, with other numbers. */
  takePresent(scene: PresentScene | null): void {
    this.present = scene;
    this.ids = new WeakMap();
    this.known = this.known.map(() => ({ bytes: null, scene: null }));
  }

  /** Returns the number of the world that a message holds; -1 without one. */
  idOf(read: Read | null): number {
    if (read === null) return -1;
    let id = this.ids.get(read);
    if (id === undefined) {
      const { data } = read.decode();
      const bytes = data instanceof Uint8Array ? data : new Uint8Array();
      id = this.known.findIndex((each) => each.bytes !== null && isEqual(each.bytes, bytes));
      if (id < 0)
        id = this.known.push({ bytes: bytes.slice(), scene: sceneOf(bytes, this.parts, this.present) }) - 1;
      this.ids.set(read, id);
    }
    return id;
  }

  of(id: number): Scene | null {
    return this.known[id]?.scene ?? null;
  }
}

const bytesOf = (all: readonly SegmentIndex[]): number =>
  all.reduce((sum, { topics }) => sum + topics.bytes, 0);

const isEqual = (a: Uint8Array, b: Uint8Array): boolean =>
  a.length === b.length && a.every((byte, at) => byte === b[at]);

const placed = (step: TickStep | undefined): TickAt | null =>
  step ? { t: step.t, tick: step.number } : null;

/** Returns the index of the last tick until a moment, which is the one that is shown; -1 before the first. */
function lastUntil(all: readonly TickStep[], t: number, tick: number | null): number {
  return all.findLastIndex((each) => each.t < t || (each.t === t && (tick === null || each.number <= tick)));
}

function push(root: [number, NodeStatus][], t: number, status: NodeStatus): void {
  if (root.at(-1)?.[1] !== status) root.push([t, status]);
}

/** Returns the last of some messages up to a time. */
function lastOf(reads: readonly Read[], t: number): Read | null {
  return reads.findLast((each) => each.t <= t) ?? null;
}

function scanOf(read: Read | null): ScanAt | null {
  if (!read) return null;
  const fields = read.decode();
  const { frame_id } = (fields['header'] ?? {}) as { frame_id?: string };
  return {
    t: read.t,
    sensor: frame_id ?? '',
    angleMin: Number(fields['angle_min']),
    angleIncrement: Number(fields['angle_increment']),
    rangeMax: Number(fields['range_max']),
    ranges: Float32Array.from(fields['ranges'] as ArrayLike<number>),
  };
}

function pictureOf(read: Read | null): PictureAt | null {
  if (!read) return null;
  const data = read.decode()['data'];
  return data instanceof Uint8Array ? { t: read.t, topic: read.topic, jpeg: data } : null;
}
