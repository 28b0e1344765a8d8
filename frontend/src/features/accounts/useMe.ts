import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { Me } from '@/api/types';

/** The question for the signed-in user, whose answer is kept. */
export const ME = { queryKey: ['me'], queryFn: api.me, staleTime: Infinity };

/** Returns the signed-in user; undefined until the server has answered. */
export function useMe(): Me | undefined {
  return useQuery(ME).data;
}
