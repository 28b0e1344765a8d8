import { useEffect } from 'react';
import { useMe } from '@/features/accounts/useMe';
import { useIsBack } from '@/store/moment/store';
import { useRunStore, type RunBlocker } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';

/** Returns the reason why the user may not run the project, and stores it for the shortcuts. */
export function useRunBlocker(): RunBlocker | null {
  const isGuest = useMe()?.role === 'guest';
  const isViewer = useSessionStore((state) => state.introspection?.role === 'viewer');
  const isBack = useIsBack();
  const runBlocker = isGuest ? 'guest' : isViewer ? 'viewer' : isBack ? 'past' : null;
  useEffect(() => {
    useRunStore.setState({ runBlocker });
  }, [runBlocker]);
  return runBlocker;
}
