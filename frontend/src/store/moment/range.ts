import { create } from 'zustand';

/** A part of a run, in s. */
export interface Span {
  readonly from: number;
  readonly to: number;
}

interface RangeData {
  /** The two moments that the user marked, in s; null if not set. */
  readonly a: number | null;
  readonly b: number | null;
  /** Whether playing repeats the part between them. */
  readonly isLooping: boolean;
  /** Whether the changes between them are listed. */
  readonly isComparing: boolean;
  /** The part of the run that the axis shows; null: all of it. */
  readonly view: Span | null;
}

export const noRange: RangeData = { a: null, b: null, isLooping: false, isComparing: false, view: null };

/** The marked range and the zoom of the time axis. */
export const useRange = create<RangeData>(() => noRange);

export const SHORTEST_S = 0.5;

/** Returns a span that lies within another; it keeps its length, if that fits. */
export function within({ from, to }: Span, all: Span): Span {
  const length = Math.min(Math.max(to - from, Math.min(SHORTEST_S, all.to - all.from)), all.to - all.from);
  const begin = Math.min(Math.max(from, all.from), all.to - length);
  return { from: begin, to: begin + length };
}

/** Returns the span after zooming by a factor (below 1: in) round a time; null: all. */
export function zoomed(view: Span | null, all: Span, factor: number, round: number): Span | null {
  const { from, to } = view ?? all;
  const next = { from: round - (round - from) * factor, to: round + (to - round) * factor };
  if (next.to - next.from >= all.to - all.from) return null;
  return within(next, all);
}

/** Returns the span moved by a share of its length. */
export function panned(view: Span | null, all: Span, share: number): Span | null {
  if (!view) return null;
  const by = (view.to - view.from) * share;
  return within({ from: view.from + by, to: view.to + by }, all);
}

/** Returns the span moved so far that it contains a time. */
export function following(view: Span | null, all: Span, t: number): Span | null {
  if (!view || (t >= view.from && t <= view.to)) return view;
  const length = view.to - view.from;
  return within(t < view.from ? { from: t, to: t + length } : { from: t - length, to: t }, all);
}

/** Returns the marked range in order; null if it has no length. */
export function markedRange({ a, b }: Pick<RangeData, 'a' | 'b'>): Span | null {
  if (a === null || b === null || a === b) return null;
  return { from: Math.min(a, b), to: Math.max(a, b) };
}

/** Returns the next moment of the playback: a loop begins again at its start. */
export function nextMoment(t: number, step: number, loop: Span | null): number {
  const next = t + step;
  if (!loop) return next;
  if (t < loop.from || t > loop.to) return loop.from;
  return next > loop.to ? loop.from : next;
}
