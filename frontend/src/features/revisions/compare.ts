import { create } from 'zustand';
import type { Revision } from '@/api/revisions';

/** The state that a revision is compared with: the one before, the current one, or another revision. */
export type Against = 'before' | 'now' | number;

export interface Comparison {
  readonly revision: Revision;
  /** The number of the revision before this one's group of saves. */
  readonly before: number;
  readonly against: Against;
  /** The path of the file that is shown; null for the first file that differs. */
  readonly path: string | null;
}

export const useComparison = create<{ comparison: Comparison | null }>(() => ({ comparison: null }));

export function setComparison(change: Partial<Comparison>): void {
  useComparison.setState(({ comparison }) =>
    comparison ? { comparison: { ...comparison, ...change } } : { comparison },
  );
}

/** Returns the two revisions, the older first. */
export function sidesOf({ revision, before, against }: Comparison, present: number): [number, number] {
  if (against === 'before') return [before, revision.number];
  const other = against === 'now' ? present : against;
  return other < revision.number ? [other, revision.number] : [revision.number, other];
}
