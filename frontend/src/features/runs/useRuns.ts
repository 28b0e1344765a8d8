import { notifications } from '@mantine/notifications';
import { useQuery, useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { fetchAgain } from '@/api/queries';
import { runs, type RunChange, type RunToKeep } from '@/api/runs';
import { useProjectStore } from '@/store/project';

/** Returns the kept runs of the open project, and functions that change them; errors are shown. */
export function useRuns() {
  const { t } = useTranslation('runs');
  const projectId = useProjectStore((state) => state.projectId) ?? '';
  const client = useQueryClient();
  const key = ['runs', projectId];
  const found = useQuery({ queryKey: key, queryFn: ({ signal }) => runs.list(projectId, signal) });
  const did = async (what: 'keep' | 'change' | 'remove', call: Promise<unknown>): Promise<boolean> => {
    try {
      await call;
      return true;
    } catch (error) {
      notifications.show({ color: 'red', title: t(`failed.${what}`), message: (error as Error).message });
      return false;
    } finally {
      await fetchAgain(client, key);
    }
  };
  return {
    projectId,
    found,
    keep: (body: RunToKeep) => did('keep', runs.keep(projectId, body)),
    change: (id: string, body: RunChange) => did('change', runs.change(projectId, id, body)),
    remove: (id: string) => did('remove', runs.remove(projectId, id)),
  };
}
