import { McapStreamReader, type McapTypes } from '@mcap/core';
import { PART_PREFIX } from './sceneParts';
import { RecordingError } from './types';

/** Some bytes of a file. */
export type Range = readonly [offset: number, length: number];

/** The end of a file: the footer with its length, and the magic number. */
const END_BYTES = 8 + 20 + 9;
const MOST_END_BYTES = 8 << 20;
/** What is read for one moment is at most as long. */
const MOST_BYTES = 16 << 20;
/** Poses are interpolated with those that follow within this time. */
const AHEAD_S = 0.25;
const TREE = '/bt/tree';
const SCENE = '/world/scene';
const DIAGRAM = /^project\/trees\/[^/]+\.json$/;
const isNeeded = (name: string): boolean => DIAGRAM.test(name) || name.startsWith(PART_PREFIX);

interface Chunk {
  readonly from: number;
  readonly range: Range;
  readonly topics: ReadonlySet<string>;
}

/**
 * Returns where the index of a file begins, from its last bytes.
 *
 * @throws RecordingError: the file has no index.
 */
export function indexBegin(end: Uint8Array, size: number): number {
  if (end.length < END_BYTES) throw unindexed('It is too short.');
  const view = new DataView(end.buffer, end.byteOffset, end.byteLength);
  const begin = Number(view.getBigUint64(end.length - 28, true));
  if (begin <= 0 || begin > size - END_BYTES || size - begin > MOST_END_BYTES)
    throw unindexed('It has no index.');
  return begin;
}

/**
 * The index at the end of a recording: which bytes show a moment, without all that precede them. Each segment of a
 * recording begins with its world, its tree and their state; from the last such begin on, nothing else is needed.
 */
export class SeekIndex {
  /** The schemas and channels of the file, as records. */
  readonly definitions: Uint8Array;
  private readonly chunks: Chunk[] = [];
  /** The diagrams of the trees, and the meshes and textures of the worlds. */
  private readonly attached: Range[] = [];

  /** @throws RecordingError: the bytes are no index of a file of this size. */
  constructor(bytes: Uint8Array, size: number) {
    const topics = new Map<number, string>();
    const indexes: McapTypes.TypedMcapRecords['ChunkIndex'][] = [];
    const inFile = (offset: bigint, length: bigint): Range => {
      if (offset + length > BigInt(size)) throw unindexed('It names bytes after its end.');
      return [Number(offset), Number(length)];
    };
    const stream = new McapStreamReader({ noMagicPrefix: true });
    stream.append(bytes);
    let left = bytes.length;
    for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
      if (record.type === 'Channel') topics.set(record.id, record.topic);
      else if (record.type === 'ChunkIndex') indexes.push(record);
      else if (record.type === 'AttachmentIndex' && isNeeded(record.name))
        this.attached.push(inFile(record.offset, record.length));
      if (record.type === 'Schema' || record.type === 'Channel') left = stream.bytesRemaining();
    }
    this.definitions = bytes.subarray(0, bytes.length - left);
    for (const each of indexes)
      this.chunks.push({
        from: Number(each.messageStartTime) / 1e9,
        range: inFile(each.chunkStartOffset, each.chunkLength + each.messageIndexLength),
        topics: new Set([...each.messageIndexOffsets.keys()].map((id) => topics.get(id) ?? '')),
      });
    this.chunks.sort((a, b) => a.range[0] - b.range[0]);
  }

  /**
   * Returns the bytes that show a moment, in their order; null where it is not worth it.
   *
   * @param back from which begin on: 0 for the last one up to the moment, 1 for the one before, and so on.
   */
  ranges(t: number, back: number): readonly Range[] | null {
    const last = this.chunks.findLastIndex(({ from }) => from <= t + AHEAD_S);
    const first = this.begin(
      this.chunks.findLastIndex(({ from }) => from <= t),
      back,
    );
    if (first === null || last < 0) return null;
    const chunks = this.chunks.slice(first, last + 1).map(({ range }) => range);
    const [begin = 0] = chunks[0] ?? [];
    const [end = 0] = chunks.at(-1) ?? [];
    const attached = this.attached.filter(([offset]) => offset < end);
    const all = [...attached, ...chunks].toSorted((a, b) => a[0] - b[0]);
    const bytes = all.reduce((sum, [, length]) => sum + length, 0);
    // From the begin of the file, the parts that are read in their order come as soon.
    return bytes > MOST_BYTES || begin === this.chunks[0]?.range[0] ? null : joined(all);
  }

  /** Returns the chunk with the world that precedes a tree. */
  private begin(last: number, back: number): number | null {
    let tree = this.lastWith(TREE, last);
    for (let left = back; left > 0; left -= 1) tree = this.lastWith(TREE, tree - 1);
    if (tree < 0) return null;
    const scene = this.lastWith(SCENE, tree);
    return scene < 0 ? tree : scene;
  }

  private lastWith(topic: string, until: number): number {
    return this.chunks.findLastIndex(({ topics }, at) => at <= until && topics.has(topic));
  }
}

/** Returns the same bytes in as few pieces as possible; what is between two near ones is read with them. */
function joined(ranges: readonly Range[]): Range[] {
  const found: [number, number][] = [];
  for (const [offset, length] of ranges) {
    const before = found.at(-1);
    if (before && offset - before[0] - before[1] <= NEAR_BYTES)
      before[1] = Math.max(before[1], offset + length - before[0]);
    else found.push([offset, length]);
  }
  return found;
}

/** Of so many bytes a request of their own costs more; they are whole records, too. */
const NEAR_BYTES = 1 << 16;

const unindexed = (message: string) => new RecordingError('damaged', message, 'the index of the recording');
