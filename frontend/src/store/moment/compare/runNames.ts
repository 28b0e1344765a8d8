import { t as text } from '@/i18n';
import { runsOf } from '@/store/recording/liveSource';
import type { SessionData } from '@/store/session/types';

/** The parts of a session that name its runs. */
export type NamedRuns = Pick<SessionData, 'segments' | 'branches'>;

/** Returns the number of a run, which it keeps: the first of the session is 1. */
export const numberOf = (run: string, { segments }: NamedRuns): number =>
  segments.find((each) => each.run === run)?.run_number ?? 0;

/** Returns what a run of the session is called: a branch by its name, with what it continues. */
export function nameOf(run: string, session: NamedRuns): string {
  const { segments, branches } = session;
  const branch = branches.find((each) => each.run === run);
  const isLast = run === runsOf(segments).at(-1);
  const name =
    branch?.name || text(isLast ? 'axis:run.last' : 'axis:run.earlier', { n: numberOf(run, session) });
  const parent = branch ? numberOf(branch.parent, session) : 0;
  return branch && parent > 0 ? text('axis:run.branch', { name, parent, t: branch.from_t.toFixed(1) }) : name;
}

/** Returns the name of a run and its result, in words and with a mark; a run that continues has none. */
export function labelOf(run: string, session: NamedRuns): string {
  const name = nameOf(run, session);
  const result = session.segments.findLast((each) => each.run === run)?.result;
  return result ? text(`axis:run.ended.${result}`, { name }) : name;
}
