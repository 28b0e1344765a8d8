/** The visible range of simulated time, in s. */
export interface Span {
  from: number;
  to: number;
}

export const SHORTEST_S = 0.5;

const STEPS = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600];

/** Returns the visible range that ends at a time; null means now. */
export function spanOf(end: number | null, length: number, begin: number, now: number): Span {
  const to = Math.min(end ?? now, Math.max(now, begin + length));
  const from = Math.max(Math.min(to - length, Math.max(now - length, begin)), begin);
  return { from, to: Math.max(from + length, to) };
}

/** Zooms a range about the point at a share of it: 0 is its start, 1 its end. */
export function zoomed({ from, to }: Span, factor: number, share: number, longest: number): Span {
  const length = Math.min(Math.max((to - from) * factor, SHORTEST_S), Math.max(longest, SHORTEST_S));
  const fixed = from + (to - from) * share;
  return { from: fixed - length * share, to: fixed + length * (1 - share) };
}

/** Returns the times of the marks on the axis, which are at least `apart` px apart. */
export function marks({ from, to }: Span, width: number, apart = 70): number[] {
  const wanted = ((to - from) * apart) / Math.max(width, 1);
  const step = STEPS.find((candidate) => candidate >= wanted) ?? 600;
  const found: number[] = [];
  for (let i = Math.ceil(from / step); i * step <= to; i++) found.push(i * step);
  return found;
}

/** Returns a time for display: `12.5 s` below a minute, otherwise `3:05`. */
export function timeLabel(t: number): string {
  if (t < 60) return `${Number(t.toFixed(2))} s`;
  const tenths = Math.round(t * 10);
  const seconds = Math.floor(tenths / 10) % 60;
  const rest = tenths % 10 === 0 ? '' : `.${tenths % 10}`;
  return `${Math.floor(tenths / 600)}:${String(seconds).padStart(2, '0')}${rest}`;
}
