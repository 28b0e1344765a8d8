import { numberAt } from '@/store/session/fields';
import type { Fields } from '../cdr';
import type { Read } from '../segmentReader';

/** The bytes of messages that a part of a recording keeps; beyond them, only some of each topic. */
const MOST_BYTES = 48 << 20;
/** A longer message, as of a picture or a cloud of points, is counted and not kept. */
export const MOST_MESSAGE_BYTES = 64 << 10;
/** What a message costs beside its bytes. */
const READ_BYTES = 250;

const OWN_TYPES = /^bt_studio_msgs\//;

/** The messages of a topic in a part of a recording. */
export interface KeptTopic {
  readonly type: string;
  /** In the order of time. */
  reads: Read[];
  /** How many messages there are, of all sizes. */
  count: number;
  bytes: number;
  /** The times of the first and the last message, in s. */
  readonly from: number;
  to: number;
  /** Of so many messages, one is kept. */
  every: number;
  isTooLarge: boolean;
  /** The values of plotted fields, as far as they were decoded: one for each of `reads`. */
  values: Map<string, number[]>;
}

/** The messages of the robot's and the project's topics in a part of a recording, within a bound of memory. */
export class TopicMessages {
  readonly topics = new Map<string, KeptTopic>();
  /** The bytes of memory of the kept messages, about. */
  bytes = 0;

  constructor(private readonly mostBytes = MOST_BYTES) {}

  add(read: Read): void {
    const { topic, type, t, data } = read;
    if (OWN_TYPES.test(type)) return;
    let kept = this.topics.get(topic);
    if (!kept) {
      const empty = { reads: [], count: 0, bytes: 0, every: 1, isTooLarge: false, values: new Map() };
      this.topics.set(topic, (kept = { type, from: t, to: t, ...empty }));
    }
    kept.count += 1;
    kept.bytes += data.length;
    kept.to = t;
    if (data.length > MOST_MESSAGE_BYTES) kept.isTooLarge = true;
    else if ((kept.count - 1) % kept.every === 0) {
      kept.reads.push(read);
      this.bytes += sizeOf(read);
      if (this.bytes > this.mostBytes) this.thin();
    }
  }

  /** Keeps half of the messages of the topic that takes most memory. */
  thin(): void {
    let [most, largest]: [number, KeptTopic | null] = [-1, null];
    for (const kept of this.topics.values()) {
      const size = kept.reads.reduce((sum, read) => sum + sizeOf(read), 0);
      if (size > most) [most, largest] = [size, kept];
    }
    if (!largest) return;
    this.bytes -= most;
    largest.every *= 2;
    largest.reads = largest.reads.filter((_, at) => at % 2 === 0);
    largest.values = new Map();
    this.bytes += largest.reads.reduce((sum, read) => sum + sizeOf(read), 0);
  }

  /** Returns the last message of a topic until a time; null without one. */
  last(topic: string, t: number): Read | null {
    const reads = this.topics.get(topic)?.reads ?? [];
    return reads.findLast((read) => read.t <= t) ?? null;
  }

  /**
   * Decodes the values of some fields of a topic further; those of other fields are forgotten.
   *
   * @param most how many messages are decoded at most.
   * @returns how many were decoded.
   */
  decode(topic: string, paths: readonly string[], most: number): number {
    const kept = this.topics.get(topic);
    if (!kept) return 0;
    for (const path of kept.values.keys()) if (!paths.includes(path)) kept.values.delete(path);
    const values = paths.map((path) => {
      const found = kept.values.get(path) ?? [];
      kept.values.set(path, found);
      return { path, found };
    });
    const begin = Math.min(kept.reads.length, ...values.map(({ found }) => found.length));
    const until = Math.min(kept.reads.length, begin + most);
    for (const [at, read] of kept.reads.slice(begin, until).entries()) {
      const fields = fieldsOf(read);
      for (const { path, found } of values)
        if (found.length === begin + at) found.push(numberAt(fields, path) ?? NaN);
    }
    return until - begin;
  }
}

/** Returns the fields of a message; null if it is damaged: it is a gap then, and the others are drawn. */
function fieldsOf(read: Read): Fields | null {
  try {
    return read.decode();
  } catch {
    return null;
  }
}

const sizeOf = ({ data }: Read): number => data.length + READ_BYTES;
