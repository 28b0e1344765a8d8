import type { Branch } from '@/generated/messages';

/** A part of a course, from and to a time in s: it is in the recording of one run. */
export interface Piece {
  readonly run: string;
  readonly from: number;
  readonly to: number;
}

type Line = Pick<Branch, 'run' | 'parent' | 'from_t'>;

/** Returns what led to a run, and the run: the first part is of the run that continues no other. */
export function courseOf(run: string, branches: readonly Line[]): Piece[] {
  const pieces: Piece[] = [];
  const seen = new Set<string>();
  let to = Infinity;
  for (let at: string | undefined = run; at !== undefined && !seen.has(at);) {
    seen.add(at);
    const name: string = at;
    const branch = branches.find((each) => each.run === name);
    const from = branch ? Math.min(branch.from_t, to) : -Infinity;
    if (from < to) pieces.unshift({ run: name, from, to });
    to = from;
    at = branch?.parent;
  }
  return pieces;
}

/** Returns the time in s at which two courses part; null if they have nothing in common. */
export function partedAt(one: readonly Piece[], other: readonly Piece[]): number | null {
  let parted: number | null = null;
  for (let at = 0; at < one.length && at < other.length; at += 1) {
    const [a, b] = [one[at], other[at]];
    if (!a || !b || a.run !== b.run) break;
    parted = Math.min(a.to, b.to);
    if (a.to !== b.to) break;
  }
  return parted;
}

/** Returns the part of a course after a time. */
export const piecesFrom = (course: readonly Piece[], t: number): Piece[] =>
  course.filter(({ to }) => to > t).map((piece) => ({ ...piece, from: Math.max(piece.from, t) }));
