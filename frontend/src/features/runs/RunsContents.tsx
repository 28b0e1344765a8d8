import { Alert, Group, Loader, Stack, Text } from '@mantine/core';
import { useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { closeRunsDialog } from '@/store/dialogs/runs';
import { openKept } from '@/store/moment/looking';
import { storedSource } from '@/store/recording/storedSource';
import { KeepForm } from './KeepForm';
import { LogButton } from './LogButton';
import { openLog } from './openLog';
import { RunRow } from './RunRow';
import { useRuns } from './useRuns';

/** The form that keeps the present run, and the list of the kept ones. */
export function RunsContents() {
  const { t } = useTranslation('runs');
  const client = useQueryClient();
  const { projectId, found, keep, change, remove } = useRuns();
  const rows = found.data ?? [];
  return (
    <>
      <KeepForm onKeep={keep} />
      <Group justify="flex-end" mb="xs">
        <LogButton onOpen={(file) => openLog(projectId, file, client, t)} />
      </Group>
      {found.isPending ? <Loader size="sm" role="status" aria-label={t('loading')} /> : null}
      {found.isError ? <Alert color="red">{found.error.message}</Alert> : null}
      {found.isSuccess && rows.length === 0 ? <Text c="dimmed">{t('none')}</Text> : null}
      <Stack component="ul" aria-label={t('title')} gap="md" p={0} m={0} style={{ listStyle: 'none' }}>
        {rows.map((run) => (
          <RunRow
            key={run.id}
            projectId={projectId}
            run={run}
            onOpen={() => {
              closeRunsDialog();
              openKept(storedSource(projectId, run), run);
            }}
            onChange={(body) => change(run.id, body)}
            onRemove={() => remove(run.id)}
          />
        ))}
      </Stack>
    </>
  );
}
