import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';
import type { State } from '@/generated/messages';

/** The displayed state: a rung of the ladder, or a more urgent condition that hides the rung. */
export type ShownState = State | 'lost' | 'silent' | 'launching' | 'fault';

/** The ends of a run that are faults. */
const FAULTS = new Set(['action_raised', 'process_died']);

export function shownState(state: SessionData): ShownState {
  const { connection, silentS, hungSince, isLaunching, finished, executor } = state;
  if (connection === 'reconnecting' || connection === 'lost') return 'lost';
  if (silentS > 0 || hungSince !== null) return 'silent';
  if (isLaunching) return 'launching';
  const isStopped = executor === 'visualization_ready' || executor === 'connected';
  return isStopped && finished && FAULTS.has(finished.reason) ? 'fault' : executor;
}

export const useShownState = () => useSessionStore(shownState);
