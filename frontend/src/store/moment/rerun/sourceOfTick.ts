import { reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import { beginSource, failSource, useTickSource, type SourceJob } from '@/store/session/trace/tickSource';
import { extent } from '../looking';
import { usePastTree } from '../pastTree';
import { useSource } from '../source';
import { useMoment } from '../store';
import { beginsAgain, canGoBack, changedByHandAt } from './goBack';
import { newJob, refusalOf } from './job';

/** Why the code of the shown tick cannot be shown. */
export type NoSource = 'present' | 'kept' | 'viewer' | 'live' | 'byHand' | 'unrepeatable' | 'noTick';

/** Returns why the code of the shown tick cannot be asked for; null if it can. */
export function whyNoSource(): NoSource | null {
  const { shown } = useMoment.getState();
  if (!shown) return 'present';
  if (useSource.getState().kept) return 'kept';
  if (useSessionStore.getState().introspection?.role !== 'driver') return 'viewer';
  if (beginsAgain()) return 'live';
  if (changedByHandAt() !== null) return 'byHand';
  if (!canGoBack()) return 'unrepeatable';
  return shown.tickT === null ? 'noTick' : null;
}

/** Whether the code that the shown tick ran can be asked for. */
export const canShowSource = (): boolean => whyNoSource() === null;

/** Returns the request for the tick at a time in s, if it is the last one. */
export const sourceAt = (job: SourceJob | null, tickT: number | null | undefined): SourceJob | null =>
  job && job.run === extent()?.run && job.t === tickT ? job : null;

/** Shows the code in the tab of the past, and asks for it where it is not known. */
export function showSource(): void {
  usePastTree.setState({ view: 'source' });
  const { shown } = useMoment.getState();
  if (canShowSource() && !sourceAt(useTickSource.getState().job, shown?.tickT)) void askSource();
}

/** Asks for what the code of the actions did in the shown tick. */
export async function askSource(): Promise<void> {
  const t = useMoment.getState().shown?.tickT ?? null;
  const run = extent()?.run;
  if (t === null || run === undefined || !canShowSource()) return;
  const job = newJob();
  beginSource(job, run, t);
  try {
    await send('source_of_tick', { job, run, t });
  } catch (error) {
    failSource(job, refusalOf(error));
  }
}

/** Ends the request that waits for its answer. */
export function stopSource(): void {
  const { job } = useTickSource.getState();
  if (job && job.found === null) void reported(send('stop_source', { job: job.id }));
}
