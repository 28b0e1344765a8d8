import type { Segment } from '@/generated/messages';
import { RunIndex } from './runIndex';
import { SegmentReader } from './segmentReader';
import type { Story } from './story';
import type { Changes, Moment, Overview, TickAt, WriteAt } from './types';

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
  | { readonly what: 'writes'; readonly scope: string; readonly key: string }
  | { readonly what: 'changes'; readonly from: number; readonly to: number };

export interface Answers {
  moment: Moment | null;
  tick: TickAt | null;
  change: TickAt | null;
  story: Story | null;
  trail: Float32Array | null;
  writes: readonly WriteAt[] | null;
  changes: Changes | null;
}

export type ToEngine =
  | { readonly kind: 'begin'; readonly run: string }
  | { readonly kind: 'part'; readonly segment: Segment; readonly bytes: Uint8Array }
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

  constructor(private readonly post: (message: FromEngine) => void) {}

  receive(message: ToEngine): void {
    switch (message.kind) {
      case 'begin':
        this.index = new RunIndex(message.run);
        this.readers = new Map();
        this.failed.clear();
        return;
      case 'part':
        return this.take(message.segment, message.bytes);
      case 'drop':
        this.index.drop(message.number);
        this.readers.delete(message.number);
        return this.tell();
      case 'ask':
        return this.post({ kind: 'answer', id: message.id, answer: this.answer(message.ask) });
    }
  }

  private take({ number, from_t, to_t, complete, bytes: size }: Segment, bytes: Uint8Array): void {
    if (this.failed.has(number)) return;
    const index = this.index.segment(number, from_t);
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
          return this.index.momentAt(ask.t, ask.known, ask.tick, ask.scene);
        case 'tick':
          return this.index.tickFrom(ask.t, ask.by, ask.tick);
        case 'change':
          return this.index.changeFrom(ask.uid, ask.t, ask.direction, ask.tick);
        case 'story':
          return this.index.storyUntil(ask.t, ask.tick);
        case 'trail':
          return this.index.trail();
        case 'writes':
          return this.index.writesOf(ask);
        case 'changes':
          return this.index.changes(ask.from, ask.to);
      }
    } catch (error) {
      this.post({ kind: 'failed', number: -1, message: (error as Error).message });
      return null;
    }
  }
}
