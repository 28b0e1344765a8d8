import { useEffect } from 'react';
import { useMe } from '@/features/accounts/useMe';
import { useRunStore, type Hindrance } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';

/** What keeps this user from running the project; also told to shortcuts, by the store. */
export function useHindrance(): Hindrance | null {
  const isGuest = useMe()?.role === 'guest';
  const isOnlooker = useSessionStore((state) => state.introspection?.role === 'viewer');
  const hindrance = isGuest ? 'guest' : isOnlooker ? 'onlooker' : null;
  useEffect(() => {
    useRunStore.setState({ hindrance });
  }, [hindrance]);
  return hindrance;
}
