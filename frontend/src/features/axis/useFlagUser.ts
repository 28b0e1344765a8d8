import { useMe } from '@/features/accounts/useMe';

/** The name under which the user's flags are set; empty where there are no accounts. */
export function useFlagUser(): string {
  const me = useMe();
  return me?.mode === 'team' ? me.name || me.user : '';
}
