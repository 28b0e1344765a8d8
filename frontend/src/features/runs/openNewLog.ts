import { notifications } from '@mantine/notifications';
import type { TFunction } from 'i18next';
import { reasonOf } from '@/api/reason';
import { runs } from '@/api/runs';
import { navigate } from '@/store/route';
import { pathOf } from './present';

/** The endings of files that can be opened on the time axis. */
export const LOG_ENDINGS = ['.mcap', '.btlog', '.db3', '.btdb'] as const;

export const isLog = ({ name }: File): boolean =>
  LOG_ENDINGS.some((ending) => name.toLowerCase().endsWith(ending));

/** Makes a project of a log of a robot, and goes to its run; an error is shown. */
export async function openNewLog(file: File, t: TFunction<'runs'>): Promise<void> {
  await reading('log', file, t, async () => navigate(pathOf(await runs.openLog(file))));
}

/** Says that a log is being read, and why it cannot be. */
export async function reading(
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
