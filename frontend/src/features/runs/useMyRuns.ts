import { notifications } from '@mantine/notifications';
import { useQuery, useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { fetchAgain } from '@/api/queries';
import { reasonOf } from '@/api/reason';
import { runs } from '@/api/runs';

const KEY = ['runs', 'mine'];

/** Returns the runs that the user has kept, and a function that deletes one; errors are shown. */
export function useMyRuns() {
  const { t } = useTranslation('runs');
  const client = useQueryClient();
  const found = useQuery({ queryKey: KEY, queryFn: ({ signal }) => runs.mine(signal), staleTime: 0 });
  const remove = async (id: string): Promise<boolean> => {
    try {
      await runs.removeMine(id);
      return true;
    } catch (error) {
      notifications.show({ color: 'red', title: t('failed.remove'), message: reasonOf(error as Error) });
      return false;
    } finally {
      await fetchAgain(client, KEY);
    }
  };
  return { found, remove };
}
