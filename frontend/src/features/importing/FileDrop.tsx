import { notifications } from '@mantine/notifications';
import { useQueryClient } from '@tanstack/react-query';
import type { TFunction } from 'i18next';
import { useCallback } from 'react';
import { useTranslation } from 'react-i18next';
import type { PartKind } from '@/api/imports';
import { failuresOf } from './failure';
import { hasImportable, sourceOfDrop } from './source';
import { openLog } from '@/features/runs/openLog';
import { isLog } from '@/features/runs/openNewLog';
import { LIMITS } from '@/generated/limits';
import { openImporting, useImporting } from '@/store/dialogs/importing';
import { closeNewRobot, useNewRobot } from '@/store/dialogs/newRobot';
import { closeNewUniverse, useNewUniverse } from '@/store/dialogs/newUniverse';
import { useProjectStore } from '@/store/project';
import { DropOverlay } from '@/ui/drop/DropOverlay';
import { useFileDrop } from '@/ui/hooks/useFileDrop';

/** Returns what the open dialogue wants; null if the files decide. */
function wantedKind(): PartKind | null {
  if (useNewRobot.getState().base !== null) return 'robot';
  if (useNewUniverse.getState().base !== null) return 'universe';
  const { isOpen, kind } = useImporting.getState();
  return isOpen ? kind : null;
}

async function openDropped(transfer: DataTransfer, t: TFunction<'importing'>): Promise<void> {
  const refuse = (message: string) => notifications.show({ color: 'red', title: t('failed'), message });
  if (useProjectStore.getState().role === 'viewer') {
    refuse(t('refused.role_too_low'));
    return;
  }
  const kind = wantedKind();
  try {
    const source = await sourceOfDrop(transfer, LIMITS.archive_entries);
    // An import that is under way is ended by its own button only.
    if (useImporting.getState().isBusy) return;
    closeNewRobot();
    closeNewUniverse();
    openImporting(kind, source);
  } catch (error) {
    for (const { message, hint } of failuresOf(t, error as Error)) refuse(`${message} ${hint}`.trim());
  }
}

/**
 * Opens what is dropped anywhere on the project's page: a log of a robot on the time axis, a robot or a world
 * in the dialogue that imports it.
 */
export function FileDrop() {
  const { t } = useTranslation('runs');
  const { t: importing } = useTranslation('importing');
  const client = useQueryClient();
  const projectId = useProjectStore((state) => state.projectId);
  const drop = useCallback(
    (file: File, transfer: DataTransfer) => {
      if (projectId === null) return;
      if (isLog(file)) void openLog(projectId, file, client, t);
      else if (hasImportable(transfer)) void openDropped(transfer, importing);
      else notifications.show({ color: 'yellow', title: t('log.other'), message: t('log.droppable') });
    },
    [projectId, client, t, importing],
  );
  return useFileDrop(drop) ? <DropOverlay>{t('log.dropHere')}</DropOverlay> : null;
}
