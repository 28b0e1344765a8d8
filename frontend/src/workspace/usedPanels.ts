import { useBreakpoints } from '@/store/debug/breakpoints';
import { useProfile } from '@/store/debug/profile';
import { useLines } from '@/store/python/lines';
import { useSessionStore } from '@/store/session/store';
import { addBehind, UNTIL_USED } from './layoutModel';
import { useTabs } from './tabs';

/** The signs that a panel is used. */
const IS_USED: Record<(typeof UNTIL_USED)[number], () => boolean> = {
  breakpoints: () =>
    useBreakpoints.getState().list.length > 0 ||
    useLines.getState().list.length > 0 ||
    useSessionStore.getState().forced !== null,
  profile: () => useProfile.getState().isWanted || (useSessionStore.getState().profile?.on ?? false),
};

/**
 * Adds the tab of a panel once it is used, behind the one that is open; one that the user closes stays closed
 * until the next use. Returns the end of it.
 */
export function followUse(): () => void {
  let used: readonly string[] = [];
  const look = () => {
    const { model } = useTabs.getState();
    if (!model) return;
    const now = UNTIL_USED.filter((id) => IS_USED[id]());
    const begun = now.filter((id) => !used.includes(id));
    used = now;
    for (const id of begun) addBehind(model, id);
  };
  const stops = [
    useBreakpoints.subscribe(look),
    useLines.subscribe(look),
    useProfile.subscribe(look),
    useSessionStore.subscribe((now, before) => {
      if (now.forced !== before.forced || now.profile?.on !== before.profile?.on) look();
    }),
    useTabs.subscribe((now, before) => {
      if (now.model === before.model) return;
      used = []; // another layout, which may lack what is in use
      look();
    }),
  ];
  look();
  return () => stops.forEach((stop) => stop());
}
