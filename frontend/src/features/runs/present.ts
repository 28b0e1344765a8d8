import type { StoredRun } from '@/api/runs';
import type { SessionData } from '@/store/session/types';

/** Returns the name of the session's last run; undefined if nothing is recorded. */
export const recordedRun = ({ segments }: Pick<SessionData, 'segments'>): string | undefined =>
  segments.at(-1)?.run;

/** Returns the end of the session's last run, as the page saw it. */
export function resultOf({
  faults,
  finished,
}: Pick<SessionData, 'faults' | 'finished'>): StoredRun['result'] {
  if (faults.length > 0) return 'error';
  if (finished === null) return 'running';
  return finished.status === 'SUCCESS' ? 'success' : 'failure';
}

/** Returns a duration as minutes and seconds, such as "2:05". */
export function minutes(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}
