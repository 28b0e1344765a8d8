import { Tooltip } from '@mantine/core';
import { useEffect, useState } from 'react';
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

/** Returns the seconds since the executor's last answer, or since a hanging tick began. */
function useSilence(): number {
  const silentS = useSessionStore((state) => state.silentS);
  const isHanging = useSessionStore((state) => state.isHanging);
  const hungS = useSessionStore((state) => Math.round(state.hungS));
  const [hangsS, setHangsS] = useState(0);
  useEffect(() => {
    if (!isHanging) return;
    const timer = setInterval(() => setHangsS((seconds) => seconds + 1), 1000);
    return () => {
      clearInterval(timer);
      setHangsS(0);
    };
  }, [isHanging]);
  return silentS > 0 ? silentS : hungS + hangsS;
}
