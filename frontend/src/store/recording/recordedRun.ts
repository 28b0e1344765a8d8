import type { Segment } from '@/generated/messages';
import type { Answers, Ask, FromEngine, ToEngine } from './engine';
import type { Overview, RecordingSource } from './types';

const PART_BYTES = 1 << 20;
/** What the engine takes at once; until it is done, no moment can be shown. */
const PIECE_BYTES = 1 << 18;
/** How long after a wish the other parts wait, so that the moments of a drag come first; at most so long. */
const QUIET_MS = 200;
const MOST_QUIET_MS = 1000;
const LOOK_AGAIN_MS = 25;
/** What is read from the end of a file for its index; a longer index is read once more. */
const END_BYTES = 1 << 18;
/** From how many earlier begins a moment is tried. */
const MOST_BACK = 2;
/** A part may be refused while the page connects, so the request is repeated for some seconds. */
const MOST_TRIES = 12;
const TRY_AGAIN_MS = 500;

/** The side of the page of an engine, which is a worker. */
export interface EngineLink {
  post(message: ToEngine): void;
  onMessage: (message: FromEngine) => void;
}

interface Held {
  version: number;
  bytes: number;
  /** Whether all of a segment that has ended was read. */
  isWhole: boolean;
}

/**
 * Reads the recording of a run while the page shows the past: first the part with the shown moment, then the others.
 * The worker with the engine answers the queries. Nothing is read while the page shows the present.
 */
export class RecordedRun {
  overview: Overview | null = null;
  private run = '';
  private wanted: number | null = null;
  private isFetching = false;
  private held = new Map<number, Held>();
  private readonly broken = new Set<number>();
  private readonly tries = new Map<number, number>();
  private readonly waiting = new Map<number, (answer: Answers[keyof Answers]) => void>();
  private nextId = 1;
  private isSeeking = false;
  private wantedAt = -Infinity;
  private readAt = -Infinity;
  /** The moments that were looked for by the index of their file. */
  private sought = new Set<number>();
  /** The moments that can be shown although the parts before them are not read. */
  private glimpsed: Answers['glimpse'] = null;
  /** Whether the index of the file was read; null: it has none. */
  private hasIndex: boolean | null = false;
  private readonly stop: () => void;

  constructor(
    private readonly source: RecordingSource,
    private readonly link: EngineLink,
    private readonly onOverview: (overview: Overview) => void,
    /** Called with the reason why a part cannot be read. */
    private readonly onFailed: (message: string) => void,
    private readonly tryAgainMs = TRY_AGAIN_MS,
  ) {
    link.onMessage = (message) => this.receive(message);
    this.stop = source.subscribe(() => this.follow());
  }

  /** Reads the parts that a moment needs, then the others; null: reads no more. */
  want(t: number | null): void {
    this.wanted = t;
    this.wantedAt = performance.now();
    this.follow();
  }

  /** Returns whether everything until a moment was read, or cannot be. */
  hasUntil(t: number): boolean {
    const segments = this.source.segments().filter(({ from_t }) => from_t <= t);
    const read = this.overview?.read ?? [];
    return segments.every(({ number, to_t }) => {
      if (this.broken.has(number) || this.held.get(number)?.isWhole) return true;
      return to_t >= t && read.some(([from, to]) => from <= t && t <= to);
    });
  }

  ask<K extends keyof Answers>(ask: Ask & { what: K }): Promise<Answers[K]> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve as (answer: Answers[keyof Answers]) => void);
      this.link.post({ kind: 'ask', id, ask });
    });
  }

  end(): void {
    this.wanted = null;
    this.stop();
  }

  private follow(): void {
    const segments = this.source.segments();
    const run = segments[0]?.run ?? '';
    if (run !== this.run) {
      this.run = run;
      this.held = new Map();
      this.broken.clear();
      this.tries.clear();
      this.overview = null;
      this.hasIndex = false;
      this.sought = new Set();
      this.glimpsed = null;
      this.link.post({ kind: 'begin', run });
    }
    for (const number of this.held.keys()) {
      if (segments.some((segment) => segment.number === number)) continue;
      this.held.delete(number);
      this.link.post({ kind: 'drop', number });
    }
    if (this.wanted === null) return;
    if (!this.isSeeking) void this.seek();
    if (!this.isFetching) void this.fetch();
  }

  /** Shows the wanted moment of a long file before the parts up to it are read. */
  private async seek(): Promise<void> {
    this.isSeeking = true;
    try {
      for (let t = this.unread(); t !== null; t = this.unread()) {
        this.sought.add(t);
        const [segment] = this.source.segments();
        if (segment) this.glimpsed = await this.glimpse(segment, t);
      }
    } catch {
      // The parts that are read in their order tell what is wrong.
      this.hasIndex = null;
    } finally {
      this.isSeeking = false;
    }
  }

  /** Returns the wanted moment if it is to be looked for by the index of the file. */
  private unread(): number | null {
    const { wanted: t, overview } = this;
    if (t === null || this.hasIndex === null || this.source.isOneFile !== true) return null;
    if (this.sought.has(t)) return null;
    const shown = [...(overview?.read ?? []), this.glimpsed ?? []];
    return shown.some(([from = 0, to = -1]) => from <= t && t <= to) ? null : t;
  }

  private async glimpse(segment: Segment, t: number): Promise<Answers['glimpse']> {
    if (this.hasIndex === false) this.hasIndex = (await this.readIndex(segment)) ? true : null;
    for (let back = 0; this.hasIndex && back < MOST_BACK; back += 1) {
      const ranges = await this.ask({ what: 'ranges', t, back });
      if (ranges === null) break;
      const read = ranges.map(([offset, length]) => this.source.read(segment, offset, length));
      const found = await this.ask({ what: 'glimpse', t, pieces: await Promise.all(read) });
      if (found) return found;
    }
    return null;
  }

  private async readIndex(segment: Segment): Promise<boolean> {
    const { bytes: size } = segment;
    for (let length = Math.min(END_BYTES, size); ;) {
      const bytes = await this.source.read(segment, size - length, length);
      const begin = await this.ask({ what: 'index', bytes, size });
      if (begin === null || begin === 0) return begin === 0;
      if (size - begin <= length) return false;
      length = size - begin;
    }
  }

  private async fetch(): Promise<void> {
    this.isFetching = true;
    try {
      for (let next = this.next(); next !== null; next = this.next()) {
        await this.quiet();
        await this.fetchPart(next);
      }
    } finally {
      this.isFetching = false;
    }
  }

  /** Waits while a moment is looked for by the index: it is shown first, and the other parts are read after it. */
  private async quiet(): Promise<void> {
    const isWaited = () => {
      if (this.source.isOneFile !== true || this.hasIndex === null || this.wanted === null) return false;
      const now = performance.now();
      const isDragged = now - this.wantedAt < QUIET_MS && now - this.readAt < MOST_QUIET_MS;
      return this.isSeeking || isDragged;
    };
    while (isWaited()) await new Promise((resolve) => setTimeout(resolve, LOOK_AGAIN_MS));
    this.readAt = performance.now();
  }

  private async fetchPart(segment: Segment): Promise<void> {
    const { run } = this;
    const held = this.held.get(segment.number) ?? { version: segment.version, bytes: 0, isWhole: false };
    try {
      // The first part is small, so that a moment at the begin is there soon.
      const most = held.bytes === 0 ? PART_BYTES : (this.source.partBytes ?? PART_BYTES);
      const length = Math.min(most, segment.bytes - held.bytes);
      const bytes = await this.source.read(segment, held.bytes, length);
      if (run !== this.run) return;
      if (bytes.length === 0) throw new Error('The part is empty.');
      held.bytes += bytes.length;
      held.isWhole = segment.complete && held.bytes >= segment.bytes;
      this.held.set(segment.number, held);
      this.tries.delete(segment.number);
      await this.take(segment, bytes, () => run === this.run && this.held.get(segment.number) === held);
    } catch (error) {
      if (run !== this.run) return;
      const current = this.source.segments().find(({ number }) => number === segment.number);
      // The segment was thinned or removed in the meantime; the next round reads the present ones.
      if (!current || current.version !== segment.version) return;
      const tries = (this.tries.get(segment.number) ?? 0) + 1;
      this.tries.set(segment.number, tries);
      if (tries >= MOST_TRIES) {
        this.broken.add(segment.number);
        this.onFailed((error as Error).message);
      } else await new Promise((resolve) => setTimeout(resolve, this.tryAgainMs));
    }
  }

  /** Gives a part to the engine in small pieces, so that it can answer between them. */
  private async take(segment: Segment, bytes: Uint8Array, isWanted: () => boolean): Promise<void> {
    for (let at = 0; at < bytes.length; at += PIECE_BYTES) {
      await this.quiet();
      if (!isWanted()) return;
      const piece = bytes.subarray(at, at + PIECE_BYTES);
      this.link.post({ kind: 'part', segment, bytes: piece, isLast: at + PIECE_BYTES >= bytes.length });
      await this.ask({ what: 'ready' });
    }
  }

  /** Returns the segment to read next: that of the wanted moment, then those before it, then the others. */
  private next(): Segment | null {
    const { wanted } = this;
    if (wanted === null) return null;
    const open = this.source.segments().filter((segment) => this.isUnread(segment));
    const distance = ({ from_t, to_t }: Segment) =>
      wanted >= from_t && wanted <= to_t ? 0 : from_t > wanted ? 1e6 + from_t - wanted : wanted - to_t;
    return open.reduce<Segment | null>(
      (best, each) => (best === null || distance(each) < distance(best) ? each : best),
      null,
    );
  }

  private isUnread(segment: Segment): boolean {
    if (this.broken.has(segment.number)) return false;
    const held = this.held.get(segment.number);
    if (!held) return segment.bytes > 0;
    if (held.version === segment.version) return segment.bytes > held.bytes;
    // A thinned segment is shorter than the part that was read.
    if (held.isWhole) return false;
    this.held.delete(segment.number);
    this.link.post({ kind: 'drop', number: segment.number });
    return true;
  }

  private receive(message: FromEngine): void {
    switch (message.kind) {
      case 'overview':
        if (message.overview.run !== this.run) return;
        this.overview = message.overview;
        return this.onOverview(message.overview);
      case 'answer':
        this.waiting.get(message.id)?.(message.answer);
        this.waiting.delete(message.id);
        return;
      case 'failed':
        if (message.number >= 0) this.broken.add(message.number);
        this.onFailed(message.message);
    }
  }
}
