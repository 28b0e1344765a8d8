import { useEffect } from 'react';
import { useSavingStore } from './store';

/** Tells the state of the save that the page shows a text that is not, or not yet, in the project. */
export function useUnsaved(isShown: boolean): void {
  useEffect(() => {
    if (!isShown) return;
    count(1);
    return () => count(-1);
  }, [isShown]);
}

const count = (more: 1 | -1) => useSavingStore.setState(({ unsaved }) => ({ unsaved: unsaved + more }));
