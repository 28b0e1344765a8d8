import { useSessionStore } from '@/store/session/store';
import { isPaused, reported } from '@/store/run/commands';
import { runOnProject } from '@/store/run/run';
import { useRunStore } from '@/store/run/store';
import { send } from '@/store/session/connection';
import { extent, lookNow } from '../looking';
import { useSource } from '../source';
import { useMoment } from '../store';

/** Whether there is a run in which world and program can go back to a past moment, by this user. */
export function mayGoBack(): boolean {
  const { introspection, connection, repeatableRuns } = useSessionStore.getState();
  const isDriver = connection === 'open' && introspection?.role === 'driver';
  return isDriver && useSource.getState().kept === null && repeatableRuns.length > 0;
}

/**
 * Returns when the debugger changed the program of the shown run, in s, if that was not after the shown moment:
 * from then on it cannot be made again. Else null.
 */
export function changedByHandAt(): number | null {
  const { t } = useMoment.getState();
  const at = useSessionStore.getState().runsByHand[extent()?.run ?? ''];
  return t !== null && at !== undefined && t >= at ? at : null;
}

/** Whether world and program can go back to the shown moment. */
export function canGoBack(): boolean {
  const { repeatableRuns, goingBack } = useSessionStore.getState();
  const run = extent()?.run;
  if (!mayGoBack() || goingBack !== null || useMoment.getState().t === null || run === undefined)
    return false;
  return repeatableRuns.includes(run) && changedByHandAt() === null;
}

/** Whether the shown run is live: then only its world goes back, and the tree begins again. */
export const beginsAgain = (): boolean =>
  useMoment.getState().t !== null && useSessionStore.getState().liveRuns.includes(extent()?.run ?? '');

/** Takes world and program back to the shown moment, where they are paused, and shows them there. */
export const goBack = () => reported(toShown());

async function toShown(): Promise<void> {
  const { t } = useMoment.getState();
  const run = extent()?.run;
  if (t === null || run === undefined || !canGoBack()) return;
  lookNow();
  await send('go_back', { run, t });
}

/** Whether the run can continue with the tree as it is now: from the shown moment, or where it is paused. */
export function canRunOn(): boolean {
  const { connection, introspection } = useSessionStore.getState();
  if (useRunStore.getState().stage !== null) return false;
  if (useMoment.getState().t !== null) return canGoBack();
  return connection === 'open' && introspection?.role === 'driver' && isPaused();
}

/** Goes back to the shown moment, if one is shown, and runs on with the project as it is now. */
export async function runOn(): Promise<void> {
  if (canRunOn()) await runOnProject(toShown);
}

/** Ends the way back; the run can be taken back again, also to its end. */
export const cancelGoBack = () => reported(send('cancel', {}));
