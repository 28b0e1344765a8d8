import { Button, Progress, Tooltip } from '@mantine/core';
import { IconArrowBackUp } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { canGoBack, cancelGoBack } from '@/store/moment/goBack';
import { useMoment } from '@/store/moment/store';
import { useSource } from '@/store/moment/source';
import { useSessionStore } from '@/store/session/store';
import classes from './axis.module.css';

/** A button that takes world and program back to the shown moment, where that is possible. */
export function GoBackButton() {
  const { t } = useTranslation('axis');
  const command = useCommandTable(({ commands }) => commands['time.goBack']);
  // What `canGoBack` asks for.
  useMoment((state) => state.t === null);
  useSource();
  const isPossible = useSessionStore(canGoBack);
  if (!command || !isPossible) return null;
  return (
    <Tooltip label={`${t('goBack.help')} (${keysOf(command)})`} multiline w={280}>
      <Button
        size="compact-xs"
        variant="default"
        className={classes['goBack']}
        aria-label={t('goBack.label')}
        leftSection={<IconArrowBackUp size={14} />}
        data-testid="axis-go-back"
        onClick={() => perform('time.goBack')}
      >
        <span className={classes['goBackText']}>{t('goBack.label')}</span>
      </Button>
    </Tooltip>
  );
}

/** How far a run is on its way back, with a button that ends it. */
export function GoingBack() {
  const { t } = useTranslation('axis');
  const fraction = useSessionStore((state) => state.goingBack);
  const isDriver = useSessionStore((state) => state.introspection?.role === 'driver');
  if (fraction === null) return null;
  const percent = Math.round(fraction * 100);
  return (
    <div className={classes['goingBack']} data-testid="axis-going-back">
      <span role="status">{t('goBack.going')}</span>
      <Progress className={classes['goingBackBar']} value={percent} aria-label={t('goBack.going')} />
      {isDriver ? (
        <Button
          size="compact-xs"
          variant="default"
          data-testid="axis-going-back-cancel"
          onClick={() => void cancelGoBack()}
        >
          {t('goBack.cancel')}
        </Button>
      ) : null}
    </div>
  );
}
