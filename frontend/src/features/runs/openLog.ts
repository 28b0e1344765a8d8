import { notifications } from '@mantine/notifications';
import type { QueryClient } from '@tanstack/react-query';
import type { TFunction } from 'i18next';
import { reasonOf } from '@/api/reason';
import { runs } from '@/api/runs';
import { closeRunsDialog } from '@/store/dialogs/runs';
import { openKept } from '@/store/moment/looking';
import { storedSource } from '@/store/recording/storedSource';

/** The endings of files that can be opened on the time axis. */
export const LOG_ENDINGS = ['.mcap', '.btlog', '.db3', '.btdb'] as const;

export const isLog = ({ name }: File): boolean =>
  LOG_ENDINGS.some((ending) => name.toLowerCase().endsWith(ending));

/** Keeps a log of a robot with the project, and shows it on the time axis; an error is shown. */
export async function openLog(
  projectId: string,
  file: File,
  client: QueryClient,
  t: TFunction<'runs'>,
): Promise<void> {
  const id = `log of ${projectId}`;
  notifications.show({ id, loading: true, message: t('log.reading', { name: file.name }), autoClose: false });
  try {
    const run = await runs.addLog(projectId, file);
    notifications.hide(id);
    closeRunsDialog();
    openKept(storedSource(projectId, run), run);
  } catch (error) {
    notifications.hide(id);
    notifications.show({ color: 'red', title: t('log.failed'), message: reasonOf(error as Error) });
  } finally {
    await client.invalidateQueries({ queryKey: ['runs', projectId] });
  }
}
