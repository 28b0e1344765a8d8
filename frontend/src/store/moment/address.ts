import { useSessionStore } from '@/store/session/store';
import { extent, lookAt } from './looking';
import { useSource } from './source';
import { useMoment } from './store';

const WRITE_AFTER_MS = 300;

/** Returns the moment that an address names: `?run=…&t=…`. */
export function momentOf(search: string): { run: string; t: number } | null {
  const query = new URLSearchParams(search);
  const run = query.get('run');
  const t = Number(query.get('t') ?? 'none');
  return run !== null && /^[0-9a-f]{1,64}$/.test(run) && Number.isFinite(t) && t >= 0 ? { run, t } : null;
}

/** Goes to the moment of the address as soon as its run is there, and keeps the address up to date. */
export function followAddress(): () => void {
  let wanted = momentOf(window.location.search);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    timer = undefined;
    const { t } = useMoment.getState();
    const run = useSource.getState().kept === null ? extent()?.run : undefined;
    const query = t === null || run === undefined ? '' : `?run=${run}&t=${t.toFixed(3)}`;
    if (window.location.search === query) return;
    window.history.replaceState(window.history.state, '', window.location.pathname + query);
  };
  const go = () => {
    if (!wanted || extent()?.run !== wanted.run) return;
    const { t } = wanted;
    wanted = null;
    lookAt(t);
  };
  go();
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
    clearTimeout(timer);
    stops.forEach((stop) => stop());
  };
}
