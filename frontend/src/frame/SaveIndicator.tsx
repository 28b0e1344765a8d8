import { Tooltip, UnstyledButton } from '@mantine/core';
import { IconAlertTriangle, IconCloudCheck, IconCloudUp, IconGitMerge } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { saveNow } from '@/store/saving/autosave';
import { useSavingStore, type SaveState } from '@/store/saving/store';
import classes from './frame.module.css';

const ICONS: Record<SaveState['kind'], typeof IconCloudCheck> = {
  saved: IconCloudCheck,
  dirty: IconCloudUp,
  saving: IconCloudUp,
  failed: IconAlertTriangle,
  conflict: IconGitMerge,
};

/** The indicator of whether the server has saved the edits; it is always visible. */
export function SaveIndicator() {
  const { t } = useTranslation('frame');
  const state = useSavingStore((saving) => saving.state);
  const Icon = ICONS[state.kind];
  const reason =
    state.kind === 'failed'
      ? state.code === 'offline'
        ? t('save.offline')
        : t('save.failedBecause', { reason: state.reason })
      : t(`save.help.${state.kind}`);
  return (
    <Tooltip label={reason} multiline maw={360}>
      <UnstyledButton
        className={classes['save']}
        data-testid="save-state"
        data-state={state.kind}
        aria-live="polite"
        onClick={() => void saveNow().catch(() => undefined)}
      >
        <Icon size={16} aria-hidden="true" />
        <span className={classes['saveText']}>
          {state.kind === 'failed'
            ? state.code === 'offline'
              ? t('save.keptOffline')
              : `${t('save.failed')}: ${state.reason}`
            : t(`save.${state.kind}`)}
        </span>
      </UnstyledButton>
    </Tooltip>
  );
}
