import { useSessionStore } from '@/store/session/store';
import { reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import { extent, lookNow } from './looking';
import { useSource } from './source';
import { useMoment } from './store';

/** Whether world and program can go back to the shown moment: in an exact run, as the driver. */
export function canGoBack(): boolean {
  const { introspection, connection, repeatableRuns, goingBack } = useSessionStore.getState();
  if (connection !== 'open' || introspection?.role !== 'driver' || goingBack !== null) return false;
  const run = extent()?.run;
  if (useSource.getState().kept !== null || useMoment.getState().t === null || run === undefined)
    return false;
  return repeatableRuns.includes(run);
}

/** Takes world and program back to the shown moment, where they are paused, and shows them there. */
export async function goBack(): Promise<void> {
  const { t } = useMoment.getState();
  const run = extent()?.run;
  if (t === null || run === undefined || !canGoBack()) return;
  lookNow();
  await reported(send('go_back', { run, t }));
}

/** Ends the way back; the run can be taken back again, also to its end. */
export const cancelGoBack = () => reported(send('cancel', {}));
