import { Tooltip } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { useSessionStore } from '@/store/session/store';
import classes from './run.module.css';

/** The executor's state in one word, with the rung of the ladder as tooltip. */
export function ExecutorState() {
  const { t } = useTranslation('run');
  const executor = useSessionStore((state) => state.executor);
  const connection = useSessionStore((state) => state.connection);
  const finished = useSessionStore((state) => state.finished);
  const isLaunching = useSessionStore((state) => state.isLaunching);
  const isSilent = useSessionStore((state) => state.silentS > 0);
  const isLost = connection === 'reconnecting' || connection === 'lost';
  const shown = isLost ? 'lost' : isSilent ? 'silent' : isLaunching ? 'launching' : executor;
  return (
    <Tooltip label={t(`stateHelp.${shown}`)}>
      <span
        className={classes['state']}
        data-testid="executor-state"
        data-state={executor}
        data-shown={shown}
        aria-live="polite"
      >
        <span className={classes['dot']} aria-hidden="true" />
        <span className={classes['stateText']}>
          {t(`state.${shown}`)}
          {finished && finished.status !== 'IDLE' && executor === 'visualization_ready'
            ? ` · ${t(`status.${finished.status}`)}`
            : null}
        </span>
      </span>
    </Tooltip>
  );
}
