import { Button } from '@mantine/core';
import { IconRotateClockwise } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import classes from './run.module.css';
import { useHasChanged } from './useHasChanged';

/** Offers a restart when the program has been edited while it runs. */
export function RestartOffer() {
  const { t } = useTranslation('run');
  const hasApplication = useSessionStore(
    ({ executor, introspection }) =>
      (executor === 'application_running' || executor === 'paused') && introspection?.role !== 'viewer',
  );
  const hasChanged = useHasChanged();
  const stage = useRunStore((state) => state.stage);
  const ranAt = useRunStore((state) => state.ranAt);
  // A declined offer appears again with the next run, not with the next edit.
  const [declined, setDeclined] = useState<number | null>(null);
  const hasProblems = useProjectStore((state) => state.diagnostics.some((d) => d.severity === 'error'));
  if (!hasApplication || !hasChanged || hasProblems || stage || declined === ranAt) return null;
  return (
    <div className={classes['offer']} role="status" data-testid="restart-offer">
      <span>
        {t('changedOffer')} <span className={classes['hint']}>{t('restartOfferHelp')}</span>
      </span>
      <Button
        size="compact-sm"
        leftSection={<IconRotateClockwise size={14} />}
        onClick={() => perform('run.restart')}
      >
        {t('restartOffer')}
      </Button>
      <Button size="compact-sm" variant="subtle" color="gray" onClick={() => setDeclined(ranAt)}>
        {t('later')}
      </Button>
    </div>
  );
}
