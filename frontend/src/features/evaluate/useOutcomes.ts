import { useQuery, useQueryClient } from '@tanstack/react-query';
import { evaluations, type Evaluation, type Outcome } from '@/api/evaluations';
import { isLive } from './useEvaluations';

const LIVE_MS = 1000;
/** As many come at once. */
const PAGE = 2000;

interface Known {
  readonly rows: ReadonlyMap<number, Outcome>;
  readonly cursor: number;
}

const nothing: Known = { rows: new Map(), cursor: 0 };

/** Returns the outcomes of a revision by seed; while the evaluation runs, new ones are added. */
export function useOutcomes(projectId: string, evaluation: Evaluation, revision: number) {
  const client = useQueryClient();
  const { id, attempt, state } = evaluation;
  const done = evaluation.sides.find((side) => side.revision === revision)?.done ?? 0;
  // At its end all are read again, since the last ones may have gone.
  const queryKey = ['outcomes', projectId, id, attempt, revision, state === 'done'];
  const found = useQuery({
    queryKey,
    queryFn: async ({ signal }): Promise<Known> => {
      let known = client.getQueryData<Known>(queryKey) ?? nothing;
      for (;;) {
        const page = await evaluations.outcomes(projectId, id, revision, known.cursor, signal);
        if (page.items.length === 0) return known;
        const rows = new Map(known.rows);
        for (const row of page.items) rows.set(row.seed, row);
        known = { rows, cursor: page.cursor };
        if (page.items.length < PAGE) return known;
      }
    },
    structuralSharing: false,
    placeholderData: (before, query) => (query?.queryKey[2] === id ? before : undefined),
    refetchInterval: ({ state: { data } }) =>
      isLive(evaluation) || (data?.rows.size ?? 0) < done ? LIVE_MS : false,
  });
  return { rows: found.data?.rows ?? nothing.rows, error: found.error };
}
