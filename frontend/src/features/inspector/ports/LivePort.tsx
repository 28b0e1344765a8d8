import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { PortSpec } from '@/model/ports';
import type { PortMark } from '@/store/run/portMarks';
import { useSessionStore } from '@/store/session/store';
import classes from './LivePort.module.css';

interface LivePortProps {
  readonly port: PortSpec;
  readonly mark: PortMark | undefined;
  readonly isTyping: boolean;
  readonly onKeep: () => void;
  readonly onBack: (before: string | null) => void;
}

/**
 * The state of a changed port in the running program, with buttons to keep the value or to restore the one
 * before.
 */
export function LivePort({ port, mark, isTyping, onKeep, onBack }: LivePortProps) {
  const { t } = useTranslation('inspector');
  const isRunning = useSessionStore(
    ({ executor, introspection }) =>
      (executor === 'application_running' || executor === 'paused') && introspection?.role === 'driver',
  );
  if (isTyping && isRunning) {
    return (
      <p className={classes['typing']} role="status">
        {t('live.typing')}
      </p>
    );
  }
  if (!mark) return null;
  // Not what the file has, which is saved with every edit, but with what the program was started.
  const before =
    mark.saved ?? (port.default === null ? t('live.noValue') : t('live.default', { value: port.default }));
  return (
    <div className={classes['live']} data-state={mark.state} data-testid={`live-${port.name}`}>
      <p className={classes['text']} role="status">
        {t(`live.${mark.state}`, { before })} {mark.message}
      </p>
      <div className={classes['buttons']}>
        <Button size="compact-sm" variant="default" onClick={onKeep}>
          {t('live.keep')}
        </Button>
        <Button
          size="compact-sm"
          variant="default"
          onClick={() => {
            onBack(mark.saved);
          }}
        >
          {t('live.back')}
        </Button>
      </div>
    </div>
  );
}
