import { ApiError } from '@/api/errors';
import { runs, type StoredRun } from '@/api/runs';
import { useProjectStore } from '@/store/project';
import { runsOf } from '@/store/recording/liveSource';
import { storedSource } from '@/store/recording/storedSource';
import { projectPath } from '@/store/route';
import { useSessionStore } from '@/store/session/store';
import { extent, openKept, openRun } from './looking';
import { useSource } from './source';
import { useMoment } from './store';

const WRITE_AFTER_MS = 300;
const SESSION_RUN = /^[0-9a-f]{1,64}$/;
const KEPT_RUN = /^[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}$/;

/** A moment of a run of a session, or of a kept one, whose id is a UUID. */
export interface Address {
  readonly run: string;
  readonly isKept: boolean;
  /** In s; null: the begin. */
  readonly t: number | null;
}

/** The reason why the run of an address is not shown: it does not exist for this user, or the request failed. */
export type Missing =
  { readonly what: 'kept' | 'session' } | { readonly what: 'failed'; readonly reason: string };

/** Returns the moment that an address names: `?run=…&t=…`. */
export function momentOf(search: string): Address | null {
  const query = new URLSearchParams(search);
  const run = query.get('run') ?? '';
  const isKept = KEPT_RUN.test(run);
  if (!isKept && !SESSION_RUN.test(run)) return null;
  const text = query.get('t');
  if (text === null) return { run, isKept, t: null };
  const t = Number(text);
  return Number.isFinite(t) && t >= 0 ? { run, isKept, t } : null;
}

/** Returns the query that names a moment. */
export const queryOf = ({ run, t }: Pick<Address, 'run' | 't'>): string =>
  `?run=${run}${t === null ? '' : `&t=${t.toFixed(3)}`}`;

/** Returns the whole address of a moment of a project's run, to be sent to others. */
export const linkTo = (projectId: string, moment: Pick<Address, 'run' | 't'>): string =>
  window.location.origin + projectPath(projectId) + queryOf(moment);

/** Returns the run and moment at which the user looks; null at the present. */
export function shownAddress(): Address | null {
  const { t } = useMoment.getState();
  const { kept } = useSource.getState();
  const run = kept?.id ?? extent()?.run;
  return t === null || run === undefined ? null : { run, isKept: kept !== null, t };
}

/**
 * Goes to the moment of the address as soon as its run is there, and keeps the address up to date.
 *
 * @param joined resolves when the page has joined the project's session, or knows that there is none.
 * @param onMissing is called if the run of the address cannot be shown.
 */
export function followAddress(joined: Promise<void>, onMissing: (missing: Missing) => void): () => void {
  const projectId = useProjectStore.getState().projectId ?? '';
  let wanted = momentOf(window.location.search);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    timer = undefined;
    const shown = shownAddress();
    const query = shown === null ? '' : queryOf(shown);
    if (window.location.search === query) return;
    window.history.replaceState(window.history.state, '', window.location.pathname + query);
  };
  const go = (): boolean => {
    if (!wanted || wanted.isKept) return false;
    const { run, t } = wanted;
    if (!runsOf(useSessionStore.getState().segments).includes(run)) return false;
    wanted = null;
    openRun(run, t);
    return true;
  };
  const open = (run: StoredRun) => {
    const t = wanted?.t ?? null;
    wanted = null;
    openKept(storedSource(projectId, run), run, t);
  };
  const seek = async (asked: Address) => {
    if (!asked.isKept) await joined;
    const isOpen = () => wanted !== asked || go();
    if (isOpen()) return;
    try {
      // A run of a session that has ended may have been kept.
      const run = asked.isKept
        ? await runs.get(projectId, asked.run)
        : (await runs.list(projectId)).find(({ recorded_as }) => recorded_as === asked.run);
      if (isOpen()) return;
      if (run) open(run);
      else onMissing({ what: 'session' });
    } catch (error) {
      if (isOpen()) return;
      const isGone = error instanceof ApiError && error.status === 404;
      onMissing(isGone ? { what: 'kept' } : { what: 'failed', reason: (error as Error).message });
    }
  };
  if (wanted && !go()) void seek(wanted);
  const stops = [
    useSessionStore.subscribe((now, before) => {
      if (now.segments !== before.segments) go();
    }),
    useMoment.subscribe((now, before) => {
      if (now.t === before.t) return;
      wanted = null;
      timer ??= setTimeout(write, WRITE_AFTER_MS);
    }),
  ];
  return () => {
    wanted = null;
    clearTimeout(timer);
    stops.forEach((stop) => stop());
  };
}
