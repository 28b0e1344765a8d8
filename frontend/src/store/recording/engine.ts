import type { Segment, TopicInfo } from '@/generated/messages';
import { Glimpse } from './glimpse';
import type { ProfileSum } from './profile';
import { RunIndex } from './runIndex';
import { indexBegin, SeekIndex, type Range } from './seekIndex';
import type { PresentScene } from './sceneParts';
import { SegmentReader } from './segmentReader';
import type { Story } from './story';
import type { RecordedTimeline } from './timelineOf';
import type { FieldName, MessageAt, RecordedSeries, SeriesRange } from './topics/topicQueries';
import { recordedTime, type Changes, type Moment, type Overview, type TickAt, type WriteAt } from './types';

export type Ask =
  | {
      readonly what: 'moment';
      readonly t: number;
      readonly tick: number | null;
      readonly known: number;
      readonly scene?: number;
    }
  | { readonly what: 'tick'; readonly t: number; readonly tick: number | null; readonly by: number }
  | {
      readonly what: 'change';
      readonly uid: number;
      readonly t: number;
      readonly tick: number | null;
      readonly direction: 1 | -1;
    }
  | { readonly what: 'story'; readonly t: number; readonly tick: number | null }
  | { readonly what: 'trail' }
  | { readonly what: 'trails' }
  | { readonly what: 'timeline' }
  /** Answered after all that was sent before. */
  | { readonly what: 'ready' }
  | { readonly what: 'index'; readonly bytes: Uint8Array; readonly size: number }
  | { readonly what: 'ranges'; readonly t: number; readonly back: number }
  | { readonly what: 'glimpse'; readonly t: number; readonly pieces: readonly Uint8Array[] }
  | { readonly what: 'writes'; readonly scope: string; readonly key: string }
  | { readonly what: 'topics' }
  | { readonly what: 'messages'; readonly topics: readonly string[]; readonly t: number }
  | { readonly what: 'series'; readonly fields: readonly FieldName[]; readonly range: SeriesRange }
  | { readonly what: 'changes'; readonly from: number; readonly to: number }
  | { readonly what: 'profile'; readonly from: number; readonly to: number };

export interface Answers {
  moment: Moment | null;
  tick: TickAt | null;
  change: TickAt | null;
  story: Story | null;
  trail: Float32Array | null;
  trails: Readonly<Record<string, Float32Array>> | null;
  timeline: RecordedTimeline | null;
  ready: null;
  /** Where the index of the file begins, if more than the given bytes are needed; 0 if it was read. */
  index: number | null;
  /** The bytes that show a moment; null where it cannot be shown without those before. */
  ranges: readonly Range[] | null;
  /** The moments that can be shown now; null if the wanted one is not among them. */
  glimpse: readonly [from: number, to: number] | null;
  writes: readonly WriteAt[] | null;
  topics: readonly TopicInfo[] | null;
  messages: readonly MessageAt[] | null;
  series: RecordedSeries | null;
  changes: Changes | null;
  profile: ProfileSum | null;
}

export type ToEngine =
  | { readonly kind: 'begin'; readonly run: string }
  | { readonly kind: 'present'; readonly scene: PresentScene }
  | {
      readonly kind: 'part';
      readonly segment: Segment;
      readonly bytes: Uint8Array;
      readonly isLast?: boolean;
    }
  | { readonly kind: 'drop'; readonly number: number }
  | { readonly kind: 'ask'; readonly id: number; readonly ask: Ask };

export type FromEngine =
  | { readonly kind: 'overview'; readonly overview: Overview }
  | { readonly kind: 'answer'; readonly id: number; readonly answer: Answers[keyof Answers] }
  | { readonly kind: 'failed'; readonly number: number; readonly message: string };

/** Reads the parts of a recording, and returns the state at any moment. It runs in a worker. */
export class Engine {
  private index = new RunIndex('');
  private readers = new Map<number, SegmentReader>();
  private readonly failed = new Set<number>();
  private seek: SeekIndex | null = null;
  private glimpse: Glimpse | null = null;
  private present: PresentScene | null = null;

  constructor(private readonly post: (message: FromEngine) => void) {}

  receive(message: ToEngine): void {
    switch (message.kind) {
      case 'begin':
        this.index = new RunIndex(message.run);
        this.index.takePresent(this.present);
        this.readers = new Map();
        this.failed.clear();
        this.seek = null;
        this.glimpse = null;
        return;
      case 'present':
        this.present = message.scene;
        this.index.takePresent(message.scene);
        return this.tell();
      case 'part':
        return this.take(message);
      case 'drop':
        this.index.drop(message.number);
        this.readers.delete(message.number);
        return this.tell();
      case 'ask':
        return this.post({ kind: 'answer', id: message.id, answer: this.answer(message.ask) });
    }
  }

  private take({ segment, bytes, isLast = true }: ToEngine & { kind: 'part' }): void {
    const { number, from_t, to_t, complete, bytes: size } = segment;
    if (this.failed.has(number)) return;
    const index = this.index.segment(number, recordedTime(from_t));
    let reader = this.readers.get(number);
    if (!reader)
      this.readers.set(
        number,
        (reader = new SegmentReader(
          `segment ${number}`,
          (read) => index.add(read),
          (name, data) => index.attach(name, data),
        )),
      );
    try {
      reader.append(bytes);
      if (reader.offset >= size) index.to = to_t;
      index.isWhole = complete && reader.offset >= size;
    } catch (error) {
      // What came before the damage stays.
      this.failed.add(number);
      this.readers.delete(number);
      this.post({ kind: 'failed', number, message: (error as Error).message });
    }
    // A complete segment needs no reader, which keeps its schemas.
    if (complete && reader.offset >= size) this.readers.delete(number);
    if (!isLast) return;
    this.index.trim();
    this.tell();
  }

  private tell(): void {
    this.post({ kind: 'overview', overview: this.index.overview() });
  }

  private answer(ask: Ask): Answers[keyof Answers] {
    try {
      switch (ask.what) {
        case 'moment':
          return this.momentAt(ask);
        case 'ready':
          return null;
        case 'index':
          return this.readIndex(ask.bytes, ask.size);
        case 'ranges':
          return this.seek?.ranges(ask.t, ask.back) ?? null;
        case 'glimpse':
          return this.look(ask.t, ask.pieces);
        case 'tick':
          return this.index.tickFrom(ask.t, ask.by, ask.tick);
        case 'change':
          return this.index.changeFrom(ask.uid, ask.t, ask.direction, ask.tick);
        case 'story':
          return this.index.storyUntil(ask.t, ask.tick);
        case 'trail':
          return this.index.trail();
        case 'trails':
          return this.index.trails();
        case 'timeline':
          return this.index.timeline();
        case 'writes':
          return this.index.writesOf(ask);
        case 'topics':
          return this.index.topics();
        case 'messages':
          return this.messagesAt(ask.topics, ask.t);
        case 'series':
          return this.index.series(ask.fields, ask.range);
        case 'changes':
          return this.index.changes(ask.from, ask.to);
        case 'profile':
          return this.index.profile(ask.from, ask.to);
      }
    } catch (error) {
      this.post({ kind: 'failed', number: -1, message: (error as Error).message });
      return null;
    }
  }

  private momentAt({ t, known, tick, scene }: Ask & { what: 'moment' }): Moment | null {
    return (
      this.index.momentAt(t, known, tick, scene) ?? this.glimpse?.momentAt(t, known, tick, scene) ?? null
    );
  }

  private messagesAt(topics: readonly string[], t: number): Answers['messages'] {
    return this.index.messagesAt(topics, t) ?? this.glimpse?.messagesAt(topics, t) ?? null;
  }

  /** The index speeds reading up; one that is damaged is left out, since the parts are read without it. */
  private readIndex(bytes: Uint8Array, size: number): number | null {
    try {
      const begin = indexBegin(bytes, size);
      if (begin < size - bytes.length) return begin;
      this.seek = new SeekIndex(bytes.subarray(begin - size + bytes.length), size);
      return 0;
    } catch {
      return null;
    }
  }

  private look(t: number, pieces: readonly Uint8Array[]): Answers['glimpse'] {
    if (!this.seek) return null;
    try {
      const found = Glimpse.of(this.index.beside(), this.seek, t, pieces);
      if (!found) return null;
      this.glimpse = found;
      this.tell();
      return found.range;
    } catch {
      // The damage is reported when the part is read in its order.
      return null;
    }
  }
}
