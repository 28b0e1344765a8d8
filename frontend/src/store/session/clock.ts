import type { SessionData } from './types';

type Clock = Pick<SessionData, 'executor' | 'sim'>;

/** Returns whether there is a world whose time is paused. */
export function isWorldPaused({ executor, sim }: Clock): boolean {
  if (executor === 'paused' || executor === 'held') return true;
  return (executor === 'universe_ready' || executor === 'visualization_ready') && (sim?.paused ?? true);
}

/** Returns whether the world runs without a program. */
export const doesWorldRunAlone = ({ executor, sim }: Clock): boolean =>
  executor === 'visualization_ready' && sim !== null && !sim.paused;
