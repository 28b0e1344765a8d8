import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { Me } from '@/api/types';

/** Returns the signed-in user; undefined until the server has answered. */
export function useMe(): Me | undefined {
  return useQuery({ queryKey: ['me'], queryFn: api.me, staleTime: Infinity }).data;
}
