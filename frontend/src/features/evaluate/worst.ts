import type { Outcome } from '@/api/evaluations';

const MOST = 5;
const COUNTED = new Set<Outcome['outcome']>(['failure', 'error', 'crashed', 'timeout']);

/** Returns the failed runs: exceptions and crashes first, then those that missed by most. */
export function worst(rows: ReadonlyMap<number, Outcome>): Outcome[] {
  const rank = ({ outcome }: Outcome) => (outcome === 'failure' ? 1 : 0);
  return [...rows.values()]
    .filter(({ outcome }) => COUNTED.has(outcome))
    .sort((a, b) => rank(a) - rank(b) || (a.margin ?? 0) - (b.margin ?? 0) || a.seed - b.seed)
    .slice(0, MOST);
}
