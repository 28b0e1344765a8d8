import { Alert, Loader, Stack, Text } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { saveNow } from '@/store/saving/autosave';
import { OtherDownloads } from './OtherDownloads';
import { PackageSection } from './PackageSection';

/**
 * The contents of the export dialogue. They save the project first, so that the export equals what the screen
 * shows.
 */
export function ExportContents() {
  const { t } = useTranslation('export');
  const projectId = useProjectStore((state) => state.projectId);
  const [saved, setSaved] = useState<'saving' | 'saved' | 'failed'>('saving');

  useEffect(() => {
    saveNow().then(
      () => setSaved('saved'),
      () => setSaved('failed'),
    );
  }, []);

  if (projectId === null) return null;
  if (saved === 'saving') {
    return (
      <Stack align="center" py="xl">
        <Loader size="sm" />
        <Text size="sm">{t('saving')}</Text>
      </Stack>
    );
  }
  return (
    <Stack gap="lg" data-testid="take-away">
      {saved === 'failed' ? (
        <Alert color="yellow" icon={<IconAlertTriangle />} title={t('notSaved')} />
      ) : null}
      <PackageSection projectId={projectId} />
      <OtherDownloads projectId={projectId} />
    </Stack>
  );
}
