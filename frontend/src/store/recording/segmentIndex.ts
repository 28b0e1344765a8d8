import { decode } from '@msgpack/msgpack';
import type { LogLevel, NodeStatus, Poses } from '@/generated/messages';
import type { Fields } from './cdr';
import { posesAt, type PosesFrame } from './posesAt';
import { profileRow, type ProfileRow } from './profile';
import { PART_PREFIX } from './sceneParts';
import type { Read } from './segmentReader';
import { TopicMessages } from './topics/topicMessages';
import {
  keyframeStep,
  tickStep,
  treeStep,
  writesStep,
  type Step,
  type TickStep,
  type WritesStep,
} from './steps';
import {
  IN_PLACE,
  RecordingError,
  STATUSES,
  writerName,
  type Entry,
  type EntryName,
  type FlagMark,
  type Mark,
  type PosesAt,
  type RecordedFault,
  type RecordedLine,
  type RecordedNode,
  type StatusOf,
  type Ticked,
  type WriteAt,
} from './types';

export const entryId = ({ scope, key }: Pick<Entry, 'scope' | 'key'>) => `${scope}\u0000${key}`;

const DIAGRAM = /^project\/trees\/[^/]+\.json$/;
const TEXT = new TextDecoder();

interface Written {
  readonly t: number;
  readonly writer: number;
}

interface LastWrite extends Written {
  readonly isRemoved: boolean;
  /** Its place among the steps. */
  readonly at: number;
}

/** A step from which the state can be put together: a tree, or a keyframe of it. */
interface Begin {
  readonly at: number;
  readonly tree: number;
}

/** What a moment says of its last tick depends on the tick before it, too. */
const LEAST_TICKS = 2;

/** The state of tree and blackboard after some steps. */
export interface State {
  generation: number;
  nodes: readonly RecordedNode[];
  files: Readonly<Record<string, string>>;
  statuses: Map<number, NodeStatus>;
  entries: Map<string, Entry>;
  written: Map<string, Written>;
  tick: TickStep | null;
  number: number;
  /** The statuses before the last tick, of the nodes that it changed. */
  was: readonly StatusOf[];
  /** The last tick itself, if the tree was halted after it: that has the number of the tick. */
  halted: Ticked | null;
  /** The place of the last step. */
  last: number;
}

/** The content of a segment, sorted by the queries for it. */
export class SegmentIndex {
  readonly steps: Step[] = [];
  readonly profile: ProfileRow[] = [];
  readonly lines: RecordedLine[] = [];
  readonly faults: RecordedFault[] = [];
  readonly marks: Mark[] = [];
  /** The flags as they were set, in order: the last one of an id holds. */
  readonly flags: FlagMark[] = [];
  readonly poses: PosesFrame[] = [];
  readonly scenes: Read[] = [];
  readonly scans: Read[] = [];
  readonly pictures = new Map<string, Read[]>();
  readonly topics = new TopicMessages();
  /** The last time that was read. */
  until = -Infinity;
  /** The time up to which all of the segment was read, in s; `from` while a part of it is missing. */
  to: number;
  /** Whether all was read, and nothing follows. */
  isWhole = false;
  private paths = new Map<number, string>();
  private files: Readonly<Record<string, string>> = {};
  /** The writes of each key, in order. */
  private readonly writes = new Map<string, LastWrite[]>();
  /** The nodes whose results were forced in the tick that comes next, and in the one before. */
  private forced: readonly number[] = [];
  private forcedBefore: readonly number[] = [];
  private readonly begins: Begin[] = [];
  private readonly bodies = new Set<number>();
  /** The places of the frames that have the poses of all bodies. */
  private readonly wholeFrames: number[] = [];

  constructor(
    readonly number: number,
    readonly from: number,
    /** The meshes and textures of scenes by their hash; all segments of a run share them. */
    private readonly parts = new Map<string, Uint8Array>(),
  ) {
    this.to = from;
  }

  add(read: Read): void {
    const { topic, t } = read;
    // Times never go back in a recording; everything that is looked up relies on it.
    if (t < this.until) throw new RecordingError('damaged', `${topic}: time runs backwards.`, `at ${t} s`);
    this.until = t;
    if (read.type === 'sensor_msgs/msg/CompressedImage') return this.addPicture(read);
    this.topics.add(read);
    switch (topic) {
      case '/bt/tree': {
        const step = treeStep(t, read.decode(), this.files);
        this.paths = new Map(step.nodes.map(({ uid, path }) => [uid, path]));
        return this.push(step);
      }
      case '/bt/keyframe':
        return this.push(keyframeStep(t, read.decode()));
      case '/bt/tick':
        return this.addTick(read);
      case '/bt/forced':
        this.forced = Array.from(read.decode()['uid'] as ArrayLike<number>);
        return;
      case '/bt/blackboard':
        return this.addWrites(writesStep(t, read.decode()));
      case '/bt/profile':
        return void this.profile.push(profileRow(t, read.decode()));
      case '/bt/log':
        return this.addLine(read);
      case '/bt/fault':
        return this.addFault(read);
      case '/bt/input':
        return this.addInput(read);
      case '/bt/flag':
        return this.addFlag(read);
      case '/bt/gap':
        return this.mark(t, 'stopped', String(read.decode()['text'] ?? ''));
      case '/world/scene':
        return void this.scenes.push(read);
      case '/world/poses':
        return this.addPoses(read);
      case '/scan':
        return void this.scans.push(read);
    }
  }

  /** Takes an attached file: it belongs to the trees that follow. */
  attach(name: string, data: Uint8Array): void {
    if (name.startsWith(PART_PREFIX)) this.parts.set(name.slice(PART_PREFIX.length), data);
    if (!DIAGRAM.test(name)) return;
    this.files = { ...this.files, [name]: TEXT.decode(data) };
  }

  /**
   * Returns the state at a time; before its first tree, that tree as it begins. Of several ticks
   * of that time, the last is `tick`.
   */
  stateAt(t: number, tick: number | null = null): State {
    const last = this.lastStep(t, tick);
    const begin = this.beginOf(last);
    const state: State = {
      generation: 0,
      nodes: [],
      files: {},
      statuses: new Map(),
      entries: new Map(),
      written: new Map(),
      tick: null,
      number: 0,
      was: [],
      halted: null,
      last,
    };
    const tree = begin && begin.tree < begin.at ? this.steps[begin.tree] : undefined;
    if (tree) apply(state, tree);
    for (const step of this.steps.slice(begin?.at ?? 0, last + 1)) apply(state, step);
    return state;
  }

  /**
   * Returns whether all is known of a moment if nothing before the first tree of this index was read: that tree
   * and enough ticks precede it.
   */
  isSettledAt(t: number): boolean {
    const first = this.begins[0]?.at;
    if (first === undefined) return false;
    const until = countUntil(this.steps, t);
    let ticks = 0;
    for (let at = first; at < until && ticks < LEAST_TICKS; at += 1)
      if (this.steps[at]?.kind === 'tick') ticks += 1;
    return ticks >= LEAST_TICKS;
  }

  /** Returns the last write of a key up to a step, also of a tree that is written again since. */
  lastWrite(id: string, last = Infinity): LastWrite | null {
    return this.writes.get(id)?.findLast(({ at }) => at <= last) ?? null;
  }

  /** Returns the writes of a key, the last one first. */
  writesOf(name: EntryName): WriteAt[] {
    const id = entryId(name);
    return (this.writes.get(id) ?? []).toReversed().flatMap(({ t, writer, isRemoved, at }): WriteAt[] => {
      const step = this.steps[at];
      if (step?.kind !== 'writes') return [];
      const value = step.writes.findLast((each) => entryId(each) === id)?.value;
      return [{ t, value, isRemoved, by: this.writerAt(at, writer) }];
    });
  }

  private writerAt(at: number, writer: number): string | null {
    if (writer === 0 || writer === IN_PLACE) return '';
    const tree = this.steps[this.begins.findLast((each) => each.at <= at)?.tree ?? -1];
    const node = tree?.kind === 'tree' ? tree.nodes.find(({ uid }) => uid === writer) : undefined;
    return node ? writerName(node) : null;
  }

  /** Returns the poses of all bodies at a time; null without any. */
  posesAt(t: number): PosesAt | null {
    return posesAt(this.poses, t, this.wholeFrames.findLast((at) => (this.poses[at]?.t ?? 0) <= t) ?? 0);
  }

  /** Returns the place of the last step of a moment; before the first tree, that of this tree. */
  private lastStep(t: number, tick: number | null): number {
    const until = countUntil(this.steps, t);
    for (let at = until - 1; tick !== null && this.steps[at]?.t === t; at -= 1) {
      const step = this.steps[at];
      if (step?.kind === 'tick' && step.number === tick) return at;
    }
    return Math.max(until - 1, this.begins[0]?.tree ?? -1);
  }

  /** Returns the last begin up to a step that has enough ticks after it; null without any. */
  private beginOf(last: number): Begin | null {
    let place = this.begins.findLastIndex(({ at }) => at <= last);
    let ticks = 0;
    let from = last + 1;
    for (; place > 0; place -= 1) {
      const { at, tree } = this.begins[place] as Begin;
      ticks += this.steps.slice(at, from).filter(({ kind }) => kind === 'tick').length;
      from = at;
      if (at === tree || ticks >= LEAST_TICKS) break;
    }
    return this.begins[place] ?? null;
  }

  private push(step: Step): void {
    const at = this.steps.push(step) - 1;
    if (step.kind === 'tree') this.begins.push({ at, tree: at });
    else if (step.kind === 'keyframe') this.begins.push({ at, tree: this.begins.at(-1)?.tree ?? at });
  }

  /** Adds a tick; a mark stands where other results than in the tick before were forced. */
  private addTick({ t, decode: told }: Read): void {
    const [forced, before] = [this.forced, this.forcedBefore];
    [this.forced, this.forcedBefore] = [[], forced];
    const step = tickStep(t, told(), forced);
    this.push(step);
    for (const uid of forced)
      if (!before.includes(uid))
        this.marks.push({ t, kind: 'forced', text: this.paths.get(uid) ?? '', uid, tick: step.number });
  }

  private addWrites(step: WritesStep): void {
    this.push(step);
    const at = this.steps.length - 1;
    for (const { writer, isRemoved, ...entry } of step.writes) {
      const id = entryId(entry);
      const all = this.writes.get(id);
      const write = { t: step.t, writer, isRemoved, at };
      if (all) all.push(write);
      else this.writes.set(id, [write]);
    }
  }

  private addLine({ t: writtenAt, decode: told }: Read): void {
    const { stamp, source, level, text, uid } = told();
    const t = happenedAt(stamp, writtenAt);
    const line = { t, source: String(source), level: level as LogLevel, text: String(text) };
    this.lines.push({ ...line, path: this.paths.get(Number(uid)) ?? '' });
    if (line.source === 'flag') this.mark(t, 'flag', line.text);
    else if (line.source === 'session') this.mark(t, 'finished', line.text);
    else if (isCollision(line)) this.mark(t, 'collision', line.text);
  }

  private addFault({ t: writtenAt, decode: told }: Read): void {
    const fields = told();
    const t = happenedAt(fields['stamp'], writtenAt);
    const of = (name: string) => String(fields[name] ?? '');
    const uid = Number(fields['uid']);
    const fault = { t, uid, kind: of('kind'), file: of('file'), line: Number(fields['line']) };
    const path = this.paths.get(uid) ?? '';
    this.faults.push({ ...fault, message: of('message'), traceback: of('traceback'), path });
    this.marks.push({ t, kind: 'fault', text: of('message'), ...(uid > 0 ? { uid } : {}) });
  }

  /** Marks where the debugger held the tree; the steps of the user from there are not marked. */
  private addInput({ t, decode: told }: Read): void {
    const { command, tick, data_json: json } = told();
    if (command !== 'hold') return;
    const { uid, path, why } = holdOf(String(json));
    if (STEP.test(why)) return;
    const text = [path, why].filter(Boolean).join(': ');
    this.marks.push({ t, kind: 'held', text, ...(uid > 0 ? { uid } : {}), tick: Number(tick) });
  }

  private addFlag({ t, decode: told }: Read): void {
    const { id, moment, text, user } = told();
    const flag = { t: secondsOf(moment) ?? t, text: String(text), id: String(id), user: String(user) };
    this.flags.push({ ...flag, kind: 'flag' });
  }

  private addPoses({ t, decode: told }: Read): void {
    const { ids, poses } = decode(told()['data'] as Uint8Array) as Poses;
    if (!(ids instanceof Uint8Array) || !(poses instanceof Uint8Array) || poses.length !== ids.length * 8)
      throw new RecordingError('wrong_type', '/world/poses: a frame is no frame of poses.', `at ${t} s`);
    const frame = { t, ids: new Uint16Array(ids.slice().buffer), poses: poses.slice() };
    const at = this.poses.push(frame) - 1;
    for (const id of frame.ids) this.bodies.add(id);
    if (frame.ids.length >= this.bodies.size) this.wholeFrames.push(at);
  }

  private addPicture(read: Read): void {
    const list = this.pictures.get(read.topic) ?? [];
    this.pictures.set(read.topic, list);
    list.push({ ...read, data: read.data });
  }

  private mark(t: number, kind: Mark['kind'], text: string): void {
    this.marks.push({ t, kind, text });
  }
}

/** Returns how many of some steps, which are in the order of time, are not later than a time. */
function countUntil(steps: readonly Step[], t: number): number {
  let [low, high] = [0, steps.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((steps[middle]?.t ?? Infinity) <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Returns the time of what arrived late at the recorder: it is written with the time of what was written before. */
const happenedAt = (stamp: unknown, writtenAt: number): number =>
  Math.min(secondsOf(stamp) ?? writtenAt, writtenAt);

/** Returns a `builtin_interfaces/Time` in s, the same number as for the time of a message; null: it is none. */
function secondsOf(time: unknown): number | null {
  const { sec, nanosec } = (time ?? {}) as Fields;
  const t = (Number(sec) * 1e9 + Number(nanosec)) / 1e9;
  return Number.isFinite(t) ? t : null;
}

/** Why the tree is held after a step of the user. */
const STEP = /^(step\b|one tick$)/;

/** Returns the data of a hold; of a damaged text there are none. */
function holdOf(json: string): { uid: number; path: string; why: string } {
  let told: Readonly<Record<string, unknown>> = {};
  try {
    const found: unknown = JSON.parse(json);
    if (typeof found === 'object' && found !== null) told = { ...found };
  } catch {
    // The mark is there all the same.
  }
  return { uid: Number(told['uid']) || 0, path: String(told['path'] ?? ''), why: String(told['why'] ?? '') };
}

/** Whether a line of the world reports a collision. */
export const isCollision = ({ source, text }: { readonly source: string; readonly text: string }) =>
  source === 'world' && /bumped into/.test(text);

/** Returns what the last tick left behind; null without one. */
const tickedOf = ({ tick, statuses, was }: State): Ticked | null =>
  tick && { statuses: [...statuses], was, flashes: tick.flashed, forced: tick.forced ?? [] };

function apply(state: State, step: Step): void {
  switch (step.kind) {
    case 'tree':
      state.generation = step.generation;
      state.nodes = step.nodes;
      state.files = step.files;
      state.statuses = new Map();
      state.entries = new Map();
      state.tick = null;
      state.was = [];
      state.halted = null;
      return;
    case 'keyframe':
      state.statuses = new Map();
      state.nodes.forEach(({ uid }, at) => {
        const code = step.status[at] ?? 0;
        if (code !== 0) state.statuses.set(uid, STATUSES[code] ?? 'IDLE');
      });
      state.entries = new Map(step.entries.map((entry) => [entryId(entry), entry]));
      state.number = step.tick;
      return;
    case 'tick':
      state.halted = step.number === state.number ? (state.halted ?? tickedOf(state)) : null;
      state.was = step.changed.map(([uid]) => [uid, state.statuses.get(uid) ?? 'IDLE']);
      for (const [uid, status] of step.changed) {
        if (status === 'IDLE') state.statuses.delete(uid);
        else state.statuses.set(uid, status);
      }
      state.tick = step;
      state.number = step.number;
      return;
    case 'writes':
      for (const write of step.writes) {
        const { isRemoved, writer, ...entry } = write;
        if (isRemoved) state.entries.delete(entryId(entry));
        else state.entries.set(entryId(entry), entry);
        state.written.set(entryId(entry), { t: step.t, writer });
      }
  }
}
