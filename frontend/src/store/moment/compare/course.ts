import type { Answers, Ask } from '@/store/recording/engine';
import { earlierSource } from '@/store/recording/liveSource';
import { RecordedRun } from '@/store/recording/recordedRun';
import { recordedTime, type RecordedNode } from '@/store/recording/types';
import { POINT_NUMBERS } from '@/store/session/trace/shownTrail';
import { askShown, extent, newLink } from '../looking';
import { identified } from '../recordedTrees';
import type { Side } from './differences';
import type { Piece } from './lines';

/** What answers for the recording of one run. */
interface Reader {
  want(t: number): void;
  ask<K extends keyof Answers>(ask: Ask & { what: K }): Promise<Answers[K] | undefined>;
  end(): void;
}

/** What a tree did, and how its part of the course stands. */
export interface SideAt extends Side {
  /** The time of the last tick in s; null before the first of this part. */
  readonly tickT: number | null;
  readonly isHalted: boolean;
}

interface Known {
  generation: number;
  nodes: readonly RecordedNode[];
  sceneId: number;
}

interface Part {
  readonly piece: Piece;
  readonly reader: Reader;
  readonly source: ReturnType<typeof earlierSource>;
  readonly known: Known;
}

/** The recording at which the user looks, which is read already. */
const shownReader: Reader = { want: () => undefined, ask: askShown, end: () => undefined };

/** Reads what happened in a run and in the runs that it continues, from the moment at which two courses part. */
export class Course {
  private readonly parts: readonly Part[];

  /** @param changed is called when more was read, and with what went wrong. */
  constructor(pieces: readonly Piece[], changed: (failure: string) => void) {
    const shown = extent()?.run;
    this.parts = pieces.map((piece): Part => {
      const source = earlierSource(piece.run);
      const reader =
        piece.run === shown
          ? shownReader
          : new RecordedRun(
              source,
              newLink(),
              () => changed(''),
              (failure) => changed(failure),
            );
      return { piece, source, reader, known: { generation: -1, nodes: [], sceneId: -1 } };
    });
  }

  /** The last recorded time, in s. */
  end(): number {
    const last = this.parts.at(-1)?.source.segments() ?? [];
    return Math.max(...last.map(({ to_t }) => to_t), this.parts.at(-1)?.piece.from ?? 0);
  }

  /** Reads what a time needs first, then all. */
  want(t: number): void {
    for (const { piece, reader } of this.parts) reader.want(Math.min(Math.max(t, piece.from), piece.to));
  }

  /** Returns what the tree did at a time; null while that is not read. */
  async at(t: number): Promise<SideAt | null> {
    const part = this.parts.findLast(({ piece }) => piece.from <= t);
    if (!part) return null;
    const { known, reader, source } = part;
    // A recording begins with its first message, which can be a little later than the run itself.
    const begin = Math.min(...source.segments().map(({ from_t }) => from_t), Infinity);
    const at = recordedTime(Number.isFinite(begin) ? Math.max(t, begin) : t);
    const moment = await reader.ask({
      what: 'moment',
      t: at,
      tick: null,
      known: known.generation,
      scene: known.sceneId,
    });
    if (!moment) return null;
    if (moment.tree) known.nodes = identified(moment.tree);
    known.generation = moment.generation;
    known.sceneId = moment.sceneId;
    const { statuses, flashes, tickT, halted } = moment;
    return { nodes: known.nodes, statuses, flashes, tickT, isHalted: halted !== null };
  }

  /** Returns the paths of all robots, as far as they were read: x, y, time, and 1 where a path begins. */
  async paths(): Promise<Float32Array[]> {
    const all = new Map<string, number[]>();
    for (const { piece, reader } of this.parts) {
      const trails = (await reader.ask({ what: 'trails' })) ?? {};
      for (const [robot, points] of Object.entries(trails)) {
        const path = all.get(robot) ?? [];
        path.push(...between(points, piece, path.length === 0));
        all.set(robot, path);
      }
    }
    return [...all.values()].map((path) => Float32Array.from(path));
  }

  /** Reads no more. */
  close(): void {
    for (const { reader } of this.parts) reader.end();
  }
}

/** Returns the points of a path within a piece of a course; those of the next piece continue where it ended. */
function between(points: Float32Array, { from, to }: Piece, isFirst: boolean): number[] {
  const found: number[] = [];
  for (let at = 0; at < points.length; at += POINT_NUMBERS) {
    const [x = 0, y = 0, t = 0, begins = 0] = points.subarray(at, at + POINT_NUMBERS);
    if (t < from || t >= to) continue;
    const isBegin = found.length === 0 ? isFirst : begins === 1;
    found.push(x, y, t, isBegin ? 1 : 0);
  }
  return found;
}
