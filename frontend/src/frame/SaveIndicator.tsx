import { Tooltip, UnstyledButton } from '@mantine/core';
import { IconAlertTriangle, IconCloudCheck, IconCloudUp, IconGitMerge } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { saveNow } from '@/store/saving/autosave';
import { useSavingStore, type SaveState } from '@/store/saving/store';
import classes from './frame.module.css';

const ICONS: Record<SaveState['kind'] | 'typing', typeof IconCloudCheck> = {
  saved: IconCloudCheck,
  dirty: IconCloudUp,
  typing: IconCloudUp,
  saving: IconCloudUp,
  failed: IconAlertTriangle,
  conflict: IconGitMerge,
};
const TYPING = { kind: 'typing' } as const;

/** The indicator of whether the server has saved what the page shows; it is always visible. */
export function SaveIndicator() {
  const { t } = useTranslation('frame');
  const saving = useSavingStore((store) => store.state);
  const isTyping = useSavingStore(({ unsaved }) => unsaved > 0);
  const state = saving.kind === 'saved' && isTyping ? TYPING : saving;
  const Icon = ICONS[state.kind];
  const isOffline = state.kind === 'failed' && state.code === 'offline';
  const reason =
    state.kind === 'failed'
      ? isOffline
        ? t('save.offline')
        : t('save.failedBecause', { reason: state.reason })
      : t(`save.help.${state.kind}`);
  return (
    <Tooltip label={reason} multiline maw={360}>
      <UnstyledButton
        className={classes['save']}
        data-testid="save-state"
        data-state={state.kind}
        data-offline={isOffline || undefined}
        aria-live="polite"
        onClick={() => void saveNow().catch(() => undefined)}
      >
        <Icon size={16} aria-hidden="true" />
        <span className={classes['saveText']}>
          {state.kind === 'failed'
            ? isOffline
              ? t('save.keptOffline')
              : `${t('save.failed')}: ${state.reason}`
            : t(`save.${state.kind}`)}
        </span>
      </UnstyledButton>
    </Tooltip>
  );
}
