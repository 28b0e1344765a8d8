import type { QueryClient } from '@tanstack/react-query';
import type { TFunction } from 'i18next';
import { fetchAgain } from '@/api/queries';
import { runs } from '@/api/runs';
import { closeRunsDialog } from '@/store/dialogs/runs';
import { openKept } from '@/store/moment/looking';
import { storedSource } from '@/store/recording/storedSource';
import { reading } from './openNewLog';

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
  await fetchAgain(client, ['runs', projectId]);
}
