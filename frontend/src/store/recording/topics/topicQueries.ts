import type { TopicInfo, TopicMessage } from '@/generated/messages';
import type { Read } from '../segmentReader';
import type { KeptTopic, TopicMessages } from './topicMessages';

/** A field of the messages of a topic. */
export interface FieldName {
  readonly topic: string;
  readonly path: string;
}

/** A part of a recording, with its place among the others. */
export interface TopicPart {
  readonly number: number;
  readonly until: number;
  readonly topics: TopicMessages;
}

/** The numbers of a field over time. */
export interface FieldSeries extends FieldName {
  /** In s; NaN among the values is a gap. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  /** Why there are no numbers, or not all of them. */
  readonly lack: Lack | null;
}

/** The topic or the field is not recorded; its messages are too large; only some of them are kept. */
export type Lack = 'topic' | 'field' | 'size' | 'thinned';

/** The numbers of some fields, from what was read of a recording. */
export interface RecordedSeries {
  readonly fields: readonly FieldSeries[];
  /** Whether nothing that was read is left to be decoded. */
  readonly isComplete: boolean;
}

/** A range of time in s. */
export interface SeriesRange {
  readonly from: number;
  readonly to: number;
  /** How many samples a field has at most; of more, the least and the greatest of each stretch are left. */
  readonly most: number;
}

/** A message as it was at a moment. */
export type MessageAt = TopicMessage & { readonly t: number };

/** How many messages are decoded for one answer; meanwhile no moment can be shown. */
const MOST_DECODED = 500;
const MOST_ELEMENTS = 64;
const MOST_TEXT = 1000;
const MOST_TOPICS = 2000;

/** Returns the topics of all parts, by name, with the mean rate while they had messages. */
export function topicsOf(parts: readonly TopicPart[]): TopicInfo[] {
  const found = new Map<string, Pick<KeptTopic, 'type' | 'count' | 'bytes' | 'from' | 'to'>>();
  for (const { topics } of parts)
    for (const [name, { type, count, bytes, from, to }] of topics.topics) {
      const before = found.get(name);
      found.set(name, {
        type,
        count: count + (before?.count ?? 0),
        bytes: bytes + (before?.bytes ?? 0),
        from: before?.from ?? from,
        to,
      });
    }
  return [...found]
    .slice(0, MOST_TOPICS)
    .map(([name, { type, count, bytes, from, to }]) => ({
      name,
      type,
      types: [type],
      publishers: [],
      subscribers: [],
      hz: to > from ? (count - 1) / (to - from) : null,
      bytes_per_s: to > from ? bytes / (to - from) : null,
    }))
    .sort((a, b) => (a.name < b.name ? -1 : 1));
}

/** Returns the last messages of some topics until a moment, from the part with it and those before it. */
export function messagesAt(parts: readonly TopicPart[], topics: readonly string[], t: number): MessageAt[] {
  return topics.flatMap((topic) => {
    const part = parts.findLast((each) => each.topics.last(topic, t) !== null);
    const read = part?.topics.last(topic, t);
    return read ? messageOf(read) : [];
  });
}

/**
 * Returns the numbers of some fields, as far as they were decoded; some more are decoded at each call. The samples
 * just outside of the range are there, too, so that lines reach its edges.
 */
export function seriesOf(
  parts: readonly TopicPart[],
  fields: readonly FieldName[],
  { from, to, most }: SeriesRange,
): RecordedSeries {
  const paths = new Map<string, string[]>();
  for (const { topic, path } of fields) paths.set(topic, [...(paths.get(topic) ?? []), path]);
  let left = MOST_DECODED;
  for (const { topics } of parts)
    for (const [topic, names] of paths) left -= topics.decode(topic, names, left);
  return {
    fields: fields.map((field) => lineOf(parts, field, from, to, most)),
    isComplete: left > 0,
  };
}

function lineOf(
  parts: readonly TopicPart[],
  { topic, path }: FieldName,
  from: number,
  to: number,
  most: number,
): FieldSeries {
  const all: Sample[] = [];
  let lack: Lack | null = 'topic';
  let hasNumber = false;
  let before: TopicPart | null = null;
  for (const part of parts) {
    // What was sent between two parts that do not follow each other is not known.
    if (before && all.length > 0 && before.number + 1 !== part.number) all.push([before.until, NaN]);
    before = part;
    const kept = part.topics.topics.get(topic);
    if (!kept) continue;
    if (kept.isTooLarge) lack = 'size';
    else if (kept.every > 1) lack = 'thinned';
    else if (lack === 'topic') lack = null;
    for (const [at, value] of (kept.values.get(path) ?? []).entries()) {
      hasNumber ||= !Number.isNaN(value);
      all.push([kept.reads[at]?.t ?? 0, Number.isFinite(value) ? value : NaN]);
    }
  }
  if (lack === null && all.length > 0 && !hasNumber) lack = 'field';
  const shown = reduced(within(all, from, to), most);
  return {
    topic,
    path,
    times: Float64Array.from(shown, ([t]) => t),
    values: Float64Array.from(shown, ([, value]) => value),
    lack,
  };
}

type Sample = readonly [t: number, value: number];

/** Returns the samples from one time to another, and one before and after them. */
function within(all: readonly Sample[], from: number, to: number): readonly Sample[] {
  const first = all.findIndex(([t]) => t >= from);
  const after = all.findIndex(([t]) => t > to);
  const begin = first < 0 ? all.length - 1 : first - 1;
  return all.slice(Math.max(0, begin), after < 0 ? all.length : after + 1);
}

/** Returns of each stretch of samples the least and the greatest, in their order. */
function reduced(all: readonly Sample[], most: number): readonly Sample[] {
  if (all.length <= most) return all;
  const size = Math.ceil((2 * all.length) / most);
  const kept: Sample[] = [];
  for (let from = 0; from < all.length; from += size) {
    const stretch = all.slice(from, from + size);
    const numbers = stretch.filter(([, value]) => !Number.isNaN(value));
    const [first] = numbers.length > 0 ? numbers : stretch;
    if (!first) continue;
    const least = numbers.reduce((best, each) => (each[1] < best[1] ? each : best), first);
    const greatest = numbers.reduce((best, each) => (each[1] > best[1] ? each : best), first);
    if (least === greatest) kept.push(least);
    else kept.push(...(least[0] <= greatest[0] ? [least, greatest] : [greatest, least]));
  }
  return kept;
}

function messageOf(read: Read): MessageAt {
  const cut: Record<string, number> = {};
  const message = shortened(read.decode(), '', cut) as Record<string, unknown>;
  return { topic: read.topic, type: read.type, message, bytes: read.data.length, cut, t: read.t };
}

/** Returns a value with at most so many elements and characters as are shown; `cut` has the lengths of others. */
function shortened(value: unknown, path: string, cut: Record<string, number>): unknown {
  if (typeof value === 'string') {
    if (value.length > MOST_TEXT) cut[path] = value.length;
    return value.slice(0, MOST_TEXT);
  }
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    const all = value as ArrayLike<unknown>;
    if (all.length > MOST_ELEMENTS) cut[path] = all.length;
    const length = Math.min(all.length, MOST_ELEMENTS);
    return Array.from({ length }, (_, at) => shortened(all[at], `${path}[${at}]`, cut));
  }
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(
    Object.entries(value).map(([name, each]) => [
      name,
      shortened(each, path ? `${path}.${name}` : name, cut),
    ]),
  );
}
