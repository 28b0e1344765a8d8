import { useQuery } from '@tanstack/react-query';
import { evaluations, type Evaluation } from '@/api/evaluations';

/** Returns the comparison of an evaluation with its older revision, once both are run. */
export function useComparison(projectId: string, { id, attempt, older, state }: Evaluation) {
  return useQuery({
    queryKey: ['comparison', projectId, id, attempt],
    queryFn: ({ signal }) => evaluations.comparison(projectId, id, signal),
    enabled: older !== null && state === 'done',
    staleTime: Infinity,
  });
}
