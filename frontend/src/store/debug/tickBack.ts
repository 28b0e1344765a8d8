import { isLookingBack } from '@/store/moment/store';
import { afterSteps, isHeld, isPaused, reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';

/** Why the run cannot go one tick back now. */
type NoTickBack = 'past' | 'viewer' | 'attached' | 'running' | 'live' | 'going';

/** Returns why the present run cannot go one tick back; null if it can, as far as this page knows. */
export function whyNoTickBack(): NoTickBack | null {
  const { introspection, attached, repeatableRuns, liveRuns, goingBack } = useSessionStore.getState();
  if (isLookingBack()) return 'past';
  if (introspection?.role === 'viewer') return 'viewer';
  if (attached) return 'attached';
  if (goingBack !== null) return 'going'; // it has no program meanwhile
  if (!isPaused() && !isHeld()) return 'running';
  return liveRuns.includes(repeatableRuns.at(-1) ?? '') ? 'live' : null;
}

/** Whether the present run can go one tick back. */
export const canTickBack = (): boolean => whyNoTickBack() === null;

/** Takes world and program to the begin of the last whole tick, where they are paused; one press after the other. */
export const tickBack = (): Promise<void> => reported(afterSteps(() => send('tick_back', {})));
