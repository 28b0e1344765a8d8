import './node';
import { readFileSync } from 'node:fs';
import type { Segment } from '@/generated/messages';
import { consoleOf, linesUntil, rowsOf } from '@/store/moment/session';
import { Engine, type FromEngine } from '@/store/recording/engine';
import { unpackPose } from '@/store/recording/posesAt';
import type { Moment, Overview } from '@/store/recording/types';

/** What is asked: the parts of a recording, and the moments in s. */
interface Wish {
  readonly parts: readonly { readonly file: string; readonly segment: Segment }[];
  readonly at: readonly number[];
}

const POSE_BYTES = 16;
const { parts, at } = JSON.parse(readFileSync(0, 'utf8')) as Wish;
const failures: string[] = [];
let overview: Overview | null = null;
let answer: unknown = null;

const engine = new Engine((message: FromEngine) => {
  if (message.kind === 'overview') overview = message.overview;
  else if (message.kind === 'failed') failures.push(message.message);
  else answer = message.answer;
});
engine.receive({ kind: 'begin', run: parts[0]?.segment.run ?? '' });
for (const { file, segment } of parts)
  engine.receive({ kind: 'part', segment, bytes: new Uint8Array(readFileSync(file)) });

const told = overview ?? { lines: [], faults: [] };
const lines = consoleOf(told);

function momentAt(t: number): Moment | null {
  engine.receive({ kind: 'ask', id: 0, ask: { what: 'moment', t, tick: null, known: -1 } });
  return answer as Moment | null;
}

/** Returns a moment as the views show it, as plain data. */
function shown(t: number) {
  const moment = momentAt(t);
  if (!moment) return null;
  const { tick, tickT, tree, statuses, flashes, entries, poses, scan } = moment;
  const ids = poses ? [...new Uint16Array(poses.ids.slice().buffer)] : [];
  const rows = rowsOf(moment, tree ?? []);
  return {
    t,
    tick,
    tickT,
    tree,
    statuses,
    flashes,
    entries,
    rows: Object.values(rows),
    poses: ids.map((id, place) => [id, poses ? unpackPose(poses.poses, place * POSE_BYTES) : []]),
    scan: scan
      ? { ...scan, ranges: [...scan.ranges].map((range) => (Number.isFinite(range) ? range : null)) }
      : null,
    console: linesUntil(lines, t).map(({ time, source, level, text, node_path }) => [
      time,
      source,
      level,
      text,
      node_path,
    ]),
  };
}

process.stdout.write(JSON.stringify({ failures, overview, moments: at.map(shown) }));
