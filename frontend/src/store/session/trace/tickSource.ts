import { create } from 'zustand';
import type { ServerMessage, SourceProgress, TickSource } from '@/generated/messages';

/** A request for what the code of the actions did in a past tick, and what is known of it. */
export interface SourceJob {
  readonly id: string;
  readonly run: string;
  /** The time of the tick in s. */
  readonly t: number;
  readonly fraction: number;
  /** The answer; with a `problem`, nothing can be shown. */
  readonly found: TickSource | null;
}

/** The last request of this page; null before the first. */
export const useTickSource = create<{ readonly job: SourceJob | null }>(() => ({ job: null }));

export const beginSource = (id: string, run: string, t: number): void =>
  useTickSource.setState({ job: { id, run, t, fraction: 0, found: null } });

function change(id: string, changed: Partial<SourceJob>): void {
  const { job } = useTickSource.getState();
  if (job?.id === id && job.found === null) useTickSource.setState({ job: { ...job, ...changed } });
}

/** Ends a request without an answer of the session. */
export function failSource(id: string, problem: string): void {
  const nothing = { calls: [], files: {}, left_out: 0, is_cut: false, differs: null };
  change(id, { found: { job: id, t: 0, tick: 0, ...nothing, problem } });
}

/** Forgets what belongs to a session that is gone. */
export const loseSource = (): void => useTickSource.setState({ job: null });

/** Takes an event of the session. */
export function feedSource({ command, data }: ServerMessage): void {
  if (command === 'source_progress') {
    const { job, fraction } = data as SourceProgress;
    change(job, { fraction });
  } else if (command === 'tick_source') {
    const found = data as TickSource;
    change(found.job, { found });
  }
}
