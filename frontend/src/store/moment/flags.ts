import { create } from 'zustand';
import { runsOf } from '@/store/recording/liveSource';
import type { Mark } from '@/store/recording/types';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import { extent } from './looking';
import { isPresentRun, useSource } from './source';
import { useMoment } from './store';

/** Two moments of less distance, in s, are one. */
const SAME_S = 5e-3;

/** A flag that is being written. */
export interface FlagDraft {
  readonly run: string;
  /** Empty: a new flag. */
  readonly id: string;
  readonly t: number;
  readonly text: string;
}

interface FlagsData {
  readonly draft: FlagDraft | null;
  /** Whether the list of all marks is shown. */
  readonly isListed: boolean;
}

export const noFlags: FlagsData = { draft: null, isListed: false };

/** What the user does with the flags of the time axis. */
export const useFlags = create<FlagsData>(() => noFlags);

/** Whether the user can set flags: in the present run while it is recorded, and as its driver. */
export function canFlag(): boolean {
  const { introspection, connection, stops } = useSessionStore.getState();
  const run = extent()?.run;
  if (run === undefined || !isPresentRun(useSource.getState())) return false;
  if (connection !== 'open' || introspection?.role !== 'driver') return false;
  return !stops.some((stop) => stop.run === run && !stop.goes_on);
}

/** Begins a flag at the shown moment, or changes the one that is there. */
export function draftFlag(): void {
  const now = extent();
  if (!now || !canFlag()) return;
  const { t } = useMoment.getState();
  const { flags, simTime } = useSessionStore.getState();
  const at = t ?? Math.max(simTime, now.to);
  const there = t === null ? undefined : flags.find((flag) => Math.abs(flag.t - at) < SAME_S);
  const { id = '', text = '', t: moment = at } = there ?? {};
  useFlags.setState({ draft: { run: now.run, id, t: moment, text } });
}

/** Begins to change a flag, if the user can. */
export function editFlag({ id, t, text }: Pick<Mark, 'id' | 't' | 'text'>): void {
  const run = extent()?.run;
  if (run !== undefined && id !== undefined && canFlag()) useFlags.setState({ draft: { run, id, t, text } });
}

/**
 * Sets or changes a flag; without text, removes it.
 *
 * @throws CommandError: the session refuses it.
 */
export const sendFlag = (draft: FlagDraft, user = ''): Promise<void> => send('flag', { ...draft, user });

/** Returns the flags and the stops of the present run, of which the session tells at once. */
export function marksOfSession(run: string): Mark[] {
  const { flags, stops } = useSessionStore.getState();
  return [
    ...flags.filter((flag) => flag.run === run).map((flag): Mark => ({ ...flag, kind: 'flag' })),
    ...stops
      .filter((stop) => stop.run === run)
      .map(({ t, detail, ...stop }): Mark => ({ t, text: detail, kind: 'stopped', stop })),
  ];
}

/** Returns where the recording of a run stopped of which nothing can be read; null if there is none. */
export function unrecorded({
  stops,
  segments,
}: Pick<ReturnType<typeof useSessionStore.getState>, 'stops' | 'segments'>) {
  const last = stops.at(-1);
  return last && !last.goes_on && !runsOf(segments).includes(last.run) ? last : null;
}
