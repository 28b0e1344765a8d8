import { Tooltip } from '@mantine/core';
import { useLayoutEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useSessionStore } from '@/store/session/store';
import classes from './run.module.css';
import { useShownState } from './useShownState';

/** The state of the executor in one word, with its rung of the ladder as a tooltip. */
export function ExecutorState() {
  const { t } = useTranslation('run');
  const executor = useSessionStore((state) => state.executor);
  const finished = useSessionStore((state) => state.finished);
  const silentS = useSilence();
  const shown = useShownState();
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
          {/* Hidden from screen readers, which would announce the seconds every second. */}
          {shown === 'silent' ? <span aria-hidden="true"> ({silentS} s)</span> : null}
          {shown === 'visualization_ready' && finished && finished.status !== 'IDLE'
            ? ` · ${t(`status.${finished.status}`)}`
            : null}
        </span>
      </span>
    </Tooltip>
  );
}

/** Returns the seconds since the session's last answer, or since a hanging tick began. */
function useSilence(): number {
  const silentS = useSessionStore((state) => state.silentS);
  const hungSince = useSessionStore((state) => state.hungSince);
  const [now, setNow] = useState(0);
  useLayoutEffect(() => {
    if (hungSince === null) return;
    // The clock is read, since a browser delays the timers of a page in the background.
    const look = () => setNow(performance.now());
    look();
    const timer = setInterval(look, 1000);
    return () => clearInterval(timer);
  }, [hungSince]);
  return silentS > 0 || hungSince === null ? silentS : Math.max(0, Math.round((now - hungSince) / 1000));
}
