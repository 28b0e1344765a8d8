import type { SessionData } from '@/store/session/types';

/** Returns the name of the session's last run; undefined if nothing is recorded. */
export const recordedRun = ({ segments }: Pick<SessionData, 'segments'>): string | undefined =>
  segments.at(-1)?.run;

/** Returns a duration as minutes and seconds, such as "2:05". */
export function minutes(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}
