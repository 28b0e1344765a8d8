import { notifications } from '@mantine/notifications';
import type { QueryClient } from '@tanstack/react-query';
import type { TFunction } from 'i18next';
import { reasonOf } from '@/api/reason';
import { runs } from '@/api/runs';
import { closeRunsDialog } from '@/store/dialogs/runs';
import { openKept } from '@/store/moment/looking';
import { storedSource } from '@/store/recording/storedSource';
import { navigate } from '@/store/route';
import { pathOf } from './present';

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
  await reading(`log of ${projectId}`, file, t, async () => {
    const run = await runs.addLog(projectId, file);
    closeRunsDialog();
    openKept(storedSource(projectId, run), run);
  });
  await client.invalidateQueries({ queryKey: ['runs', projectId] });
}

/** Makes a project of a log of a robot, and goes to its run; an error is shown. */
export async function openNewLog(file: File, t: TFunction<'runs'>): Promise<void> {
  await reading('log', file, t, async () => navigate(pathOf(await runs.openLog(file))));
}

async function reading(
  id: string,
  file: File,
  t: TFunction<'runs'>,
  read: () => Promise<void>,
): Promise<void> {
  notifications.show({ id, loading: true, message: t('log.reading', { name: file.name }), autoClose: false });
  try {
    await read();
    notifications.hide(id);
  } catch (error) {
    notifications.hide(id);
    notifications.show({ color: 'red', title: t('log.failed'), message: reasonOf(error as Error) });
  }
}
