import type { Overview } from '@/store/recording/types';
import type { Mark } from '@/store/recording/types';
import { isCollision } from '@/store/recording/segmentIndex';
import type { LogLine } from '@/store/session/types';
import { BIT, type Stretch } from '@/store/session/trace/nodeTrace';

type Range = readonly [from: number, to: number];

/** Returns the statuses of the root over time: as recorded where that was read, else as the page saw them. */
export function rootStretches(overview: Overview | null, seen: readonly Stretch[], to: number): Stretch[] {
  const read = overview?.read ?? [];
  const recorded = (overview?.root ?? []).flatMap(([start, status], at, all) => {
    const end = all[at + 1]?.[0] ?? to;
    return read.flatMap((range) => within({ start, end, mask: BIT[status] }, range));
  });
  return [...seen.flatMap((stretch) => outside(stretch, read)), ...recorded].filter(({ mask }) => mask !== 0);
}

function within(stretch: Stretch, [from, to]: Range): Stretch[] {
  const start = Math.max(stretch.start, from);
  const end = Math.min(stretch.end, to);
  return end > start ? [{ ...stretch, start, end }] : [];
}

/** Returns the parts of a stretch outside of ranges, which are in order. */
function outside(stretch: Stretch, ranges: readonly Range[]): Stretch[] {
  const parts: Stretch[] = [];
  let { start } = stretch;
  for (const [from, to] of ranges) {
    if (to <= start) continue;
    if (from > start) parts.push({ ...stretch, start, end: Math.min(from, stretch.end) });
    start = Math.max(start, to);
    if (start >= stretch.end) return parts;
  }
  return [...parts, { ...stretch, start }];
}

/**
 * Returns the marks of a run: as recorded where that was read, else from the console of the page.
 *
 * @param own flags and stops of the present run, which replace the recorded ones; null: of another run.
 */
export function marksOf(
  overview: Overview | null,
  logs: readonly LogLine[],
  from: number,
  own: readonly Mark[] | null = null,
): Mark[] {
  const begin = logs.findLastIndex(({ run }) => run !== undefined) + 1;
  const isRead = (t: number) => overview?.read.some(([start, end]) => t >= start && t <= end) ?? false;
  const seen: Mark[] = [];
  for (const line of logs.slice(begin)) {
    const { time: t, text, level, source } = line;
    if (t < from || isRead(t)) continue;
    if (isCollision({ source, text })) seen.push({ t, kind: 'collision', text });
    else if (level === 'error' && source !== 'world' && seen.at(-1)?.t !== t)
      seen.push({ t, kind: 'fault', text });
  }
  const isOwn = ({ id, kind }: Mark) => kind === 'stopped' || (kind === 'flag' && id !== undefined);
  const recorded = (overview?.marks ?? []).filter((mark) => own === null || !isOwn(mark));
  return [...recorded, ...seen, ...(own ?? [])].sort((a, b) => a.t - b.t);
}

/** Drops marks that would lie under another one; a flag stays rather than a fault or a hold, which rather than others. */
export function apart(marks: readonly Mark[], leastS: number): Mark[] {
  const rank = { stopped: 0, flag: 1, fault: 2, held: 3, forced: 4, finished: 5, collision: 6 };
  const kept: Mark[] = [];
  for (const mark of [...marks].sort((a, b) => rank[a.kind] - rank[b.kind] || a.t - b.t))
    if (kept.every((other) => Math.abs(other.t - mark.t) >= leastS)) kept.push(mark);
  return kept.sort((a, b) => a.t - b.t);
}
