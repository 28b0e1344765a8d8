import { notifications } from '@mantine/notifications';
import { useQueryClient } from '@tanstack/react-query';
import { useCallback } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { useFileDrop } from '@/ui/hooks/useFileDrop';
import { openLog } from './openLog';
import { isLog } from './openNewLog';

/** Opens a log of a robot that is dropped anywhere on the project's page. */
export function LogDrop() {
  const { t } = useTranslation('runs');
  const client = useQueryClient();
  const projectId = useProjectStore((state) => state.projectId);
  const drop = useCallback(
    (file: File) => {
      if (projectId === null) return;
      if (isLog(file)) void openLog(projectId, file, client, t);
      else notifications.show({ color: 'yellow', title: t('log.other'), message: t('log.kinds') });
    },
    [projectId, client, t],
  );
  useFileDrop(drop);
  return null;
}
