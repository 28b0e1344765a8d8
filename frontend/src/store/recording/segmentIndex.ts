import { decode } from '@msgpack/msgpack';
import type { LogLevel, NodeStatus, Poses } from '@/generated/messages';
import type { PosesFrame } from './posesAt';
import type { Read } from './segmentReader';
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
  RecordingError,
  STATUSES,
  type Entry,
  type Mark,
  type RecordedFault,
  type RecordedLine,
  type RecordedNode,
  type StatusOf,
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
}

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
  /** Whether the tree was halted after the last tick: that has the number of the tick. */
  isHalted: boolean;
}

/** The content of a segment, sorted by the queries for it. */
export class SegmentIndex {
  readonly steps: Step[] = [];
  readonly lines: RecordedLine[] = [];
  readonly faults: RecordedFault[] = [];
  readonly marks: Mark[] = [];
  readonly poses: PosesFrame[] = [];
  readonly scenes: Read[] = [];
  readonly scans: Read[] = [];
  readonly pictures = new Map<string, Read[]>();
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

  constructor(
    readonly number: number,
    readonly from: number,
  ) {
    this.to = from;
  }

  add(read: Read): void {
    const { topic, t } = read;
    // Times never go back in a recording; everything that is looked up relies on it.
    if (t < this.until) throw new RecordingError('damaged', `${topic}: time runs backwards.`, `at ${t} s`);
    this.until = t;
    if (read.type === 'sensor_msgs/msg/CompressedImage') return this.addPicture(read);
    switch (topic) {
      case '/bt/tree': {
        const step = treeStep(t, read.decode(), this.files);
        this.paths = new Map(step.nodes.map(({ uid, path }) => [uid, path]));
        return void this.steps.push(step);
      }
      case '/bt/keyframe':
        return void this.steps.push(keyframeStep(t, read.decode()));
      case '/bt/tick':
        return void this.steps.push(tickStep(t, read.decode()));
      case '/bt/blackboard':
        return this.addWrites(writesStep(t, read.decode()));
      case '/bt/log':
        return this.addLine(read);
      case '/bt/fault':
        return this.addFault(read);
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
    if (!DIAGRAM.test(name)) return;
    this.files = { ...this.files, [name]: TEXT.decode(data) };
  }

  /**
   * Returns the state at a time; before its first tree, that tree as it begins. Of several ticks
   * of that time, the last is `tick`.
   */
  stateAt(t: number, tick: number | null = null): State {
    let last = -1;
    let begin = -1;
    for (const [index, step] of this.steps.entries()) {
      if (step.t > t && begin >= 0) break;
      last = index;
      if (step.kind === 'tree') begin = index;
    }
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
      isHalted: false,
    };
    for (const step of this.steps.slice(Math.max(begin, 0), last + 1)) {
      apply(state, step);
      if (step.kind === 'tick' && step.t === t && step.number === tick) break;
    }
    return state;
  }

  /** Returns the last write of a key up to a time, also of a tree that is written again since. */
  lastWrite(id: string, until: number): LastWrite | null {
    return this.writes.get(id)?.findLast(({ t }) => t <= until) ?? null;
  }

  private addWrites(step: WritesStep): void {
    this.steps.push(step);
    for (const { writer, isRemoved, ...entry } of step.writes) {
      const id = entryId(entry);
      const all = this.writes.get(id);
      const write = { t: step.t, writer, isRemoved };
      if (all) all.push(write);
      else this.writes.set(id, [write]);
    }
  }

  private addLine({ t, decode: told }: Read): void {
    const { source, level, text, uid } = told();
    const line = { t, source: String(source), level: level as LogLevel, text: String(text) };
    this.lines.push({ ...line, path: this.paths.get(Number(uid)) ?? '' });
    if (line.source === 'flag') this.mark(t, 'flag', line.text);
    else if (line.source === 'session') this.mark(t, 'finished', line.text);
    else if (isCollision(line)) this.mark(t, 'collision', line.text);
  }

  private addFault({ t, decode: told }: Read): void {
    const fields = told();
    const of = (name: string) => String(fields[name] ?? '');
    const uid = Number(fields['uid']);
    const fault = { t, uid, kind: of('kind'), file: of('file'), line: Number(fields['line']) };
    const path = this.paths.get(uid) ?? '';
    this.faults.push({ ...fault, message: of('message'), traceback: of('traceback'), path });
    this.mark(t, 'fault', of('message'));
  }

  private addPoses({ t, decode: told }: Read): void {
    const { ids, poses } = decode(told()['data'] as Uint8Array) as Poses;
    if (!(ids instanceof Uint8Array) || !(poses instanceof Uint8Array) || poses.length !== ids.length * 8)
      throw new RecordingError('wrong_type', '/world/poses: a frame is no frame of poses.', `at ${t} s`);
    this.poses.push({ t, ids: new Uint16Array(ids.slice().buffer), poses: poses.slice() });
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

/** Whether a line of the world reports a collision. */
export const isCollision = ({ source, text }: { readonly source: string; readonly text: string }) =>
  source === 'world' && /bumped into/.test(text);

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
      state.isHalted = false;
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
      state.was = step.changed.map(([uid]) => [uid, state.statuses.get(uid) ?? 'IDLE']);
      state.isHalted = step.number === state.number && state.tick !== null;
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
