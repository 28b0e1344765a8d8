import { reasonOf } from '@/api/reason';
import { useProjectStore } from '@/store/project';
import { send } from '@/store/session/connection';
import { isUnconnected } from '@/store/session/control';
import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';
import { shownBreakpoints, useBreakpoints } from './breakpoints';

const isDriver = ({ connection, introspection }: SessionData) =>
  connection === 'open' && introspection?.role === 'driver';

let given = '';

/** Gives the session the breakpoints of this page while it drives, at once and after each change. */
export function followBreakpoints(): () => void {
  const stops = [
    useSessionStore.subscribe((now, before) => {
      if (isDriver(now) && !isDriver(before)) void give();
      // The session has switched them off: a hold has lasted too long.
      if (now.areBreakpointsOff && !before.areBreakpointsOff && isDriver(now)) {
        useBreakpoints.setState({ areOn: false });
      }
    }),
    useBreakpoints.subscribe(() => void giveChanged()),
    useProjectStore.subscribe((now, before) => {
      if (now.diagrams !== before.diagrams) void giveChanged();
    }),
  ];
  void give();
  return () => stops.forEach((stop) => stop());
}

const wanted = () => ({ breakpoints: [...shownBreakpoints()], on: useBreakpoints.getState().areOn });

async function giveChanged(): Promise<void> {
  if (JSON.stringify(wanted()) !== given) await give();
}

async function give(): Promise<void> {
  if (!isDriver(useSessionStore.getState())) return;
  const data = wanted();
  given = JSON.stringify(data);
  let refusal = '';
  try {
    await send('set_breakpoints', data);
  } catch (error) {
    if (isUnconnected(error)) return;
    refusal = reasonOf(error);
  }
  if (useBreakpoints.getState().refusal !== refusal) useBreakpoints.setState({ refusal });
}
