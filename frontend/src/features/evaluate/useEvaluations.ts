import { notifications } from '@mantine/notifications';
import { useQuery, useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { evaluations, type Evaluation } from '@/api/evaluations';
import { fetchAgain } from '@/api/queries';
import { useProjectStore } from '@/store/project';
import { saveNow } from '@/store/saving/autosave';
import { refusalText } from '@/i18n/evaluationReasons';

const LIVE_MS = 1000;
const IDLE_MS = 20_000;

export const isLive = ({ state }: Pick<Evaluation, 'state'>): boolean =>
  state === 'waiting' || state === 'running';

/** Returns the newest older revision of which the same evaluation has outcomes. */
export const earlierOf = (shown: Evaluation, items: readonly Evaluation[]): number | null =>
  items.find(
    ({ name, revision, sides }) =>
      name === shown.name && revision < shown.revision && (sides[0]?.done ?? 0) > 0,
  )?.revision ?? null;

type Act = 'start' | 'cancel' | 'resume' | 'compare' | 'remove';

/** Returns the evaluations of the open project, and what can be done with them; errors are shown. */
export function useEvaluations(isVisible: boolean) {
  const { t } = useTranslation('evaluate');
  const projectId = useProjectStore((state) => state.projectId) ?? '';
  const client = useQueryClient();
  const queryKey = ['evaluations', projectId];
  const found = useQuery({
    queryKey,
    queryFn: ({ signal }) => evaluations.list(projectId, signal),
    enabled: isVisible && projectId !== '',
    refetchInterval: ({ state }) => (state.data?.items.some(isLive) ? LIVE_MS : IDLE_MS),
  });
  const did = async <T>(what: Act, call: () => Promise<T>): Promise<T | null> => {
    try {
      return await call();
    } catch (error) {
      notifications.show({
        color: 'red',
        title: t(`failed.${what}`),
        message: refusalText(t, error as Error),
      });
      return null;
    } finally {
      await fetchAgain(client, queryKey);
    }
  };
  return {
    projectId,
    found,
    start: (name: string, runs: number, sealed: boolean) =>
      did('start', async () => {
        await saveNow(); // what is evaluated is the last revision
        return evaluations.start(projectId, name, runs, sealed);
      }),
    cancel: (id: string) => did('cancel', () => evaluations.cancel(projectId, id)),
    resume: (id: string) => did('resume', () => evaluations.resume(projectId, id)),
    compare: (id: string, revision: number) =>
      did('compare', () => evaluations.compare(projectId, id, revision)),
    remove: (id: string) => did('remove', () => evaluations.remove(projectId, id)),
  };
}
