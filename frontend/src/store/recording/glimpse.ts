import type { RunIndex } from './runIndex';
import { SegmentReader } from './segmentReader';
import type { SeekIndex } from './seekIndex';
import type { MessageAt } from './topics/topicQueries';
import type { Moment } from './types';

/** The moments around one of a recording whose parts before it are not read. */
export class Glimpse {
  private from = Infinity;
  private to = -Infinity;

  private constructor(private readonly index: RunIndex) {}

  /**
   * Reads the bytes that a `SeekIndex` names for a moment; null where they do not tell all of it.
   *
   * @param index an empty index of the run.
   * @throws RecordingError: the bytes are damaged.
   */
  static of(index: RunIndex, seek: SeekIndex, t: number, pieces: readonly Uint8Array[]): Glimpse | null {
    const glimpse = new Glimpse(index);
    const segment = index.segment(0, 0);
    const reader = new SegmentReader(
      'a part of the recording',
      (read) => {
        segment.add(read);
        if (glimpse.from === Infinity && segment.isSettledAt(read.t)) glimpse.from = read.t;
      },
      (name, data) => segment.attach(name, data),
      true,
    );
    for (const bytes of [seek.definitions, ...pieces]) reader.append(bytes);
    // At its end, what follows is missing to interpolate poses.
    glimpse.to = Math.max(t, segment.until - 1);
    segment.to = glimpse.to;
    return glimpse.from <= t ? glimpse : null;
  }

  /** As that of `RunIndex`; null for a moment that it does not show. */
  momentAt(t: number, ...known: readonly [number, number | null, number?]): Moment | null {
    return this.from <= t && t <= this.to ? this.index.momentAt(t, ...known) : null;
  }

  /** As that of `RunIndex`: a message before the bytes that were read is missing. */
  messagesAt(topics: readonly string[], t: number): MessageAt[] | null {
    return this.from <= t && t <= this.to ? this.index.messagesAt(topics, t) : null;
  }

  /** The moments that it shows. */
  get range(): readonly [from: number, to: number] {
    return [this.from, this.to];
  }
}
