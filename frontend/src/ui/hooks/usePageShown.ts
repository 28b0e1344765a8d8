import { useSyncExternalStore } from 'react';

const listen = (changed: () => void) => {
  document.addEventListener('visibilitychange', changed);
  return () => document.removeEventListener('visibilitychange', changed);
};

/** Returns whether the page is shown, and not behind another tab. */
export const usePageShown = (): boolean => useSyncExternalStore(listen, () => !document.hidden);
