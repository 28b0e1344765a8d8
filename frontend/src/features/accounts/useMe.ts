import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { Me } from '@/api/types';

/** Who the user is; undefined until the server has said so. */
export function useMe(): Me | undefined {
  return useQuery({ queryKey: ['me'], queryFn: api.me, staleTime: Infinity }).data;
}
