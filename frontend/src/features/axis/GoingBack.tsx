import { Button, Progress, Tooltip } from '@mantine/core';
import { IconArrowBackUp, IconArrowForwardUp } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import {
  beginsAgain,
  canGoBack,
  cancelGoBack,
  canRunOn,
  changedByHandAt,
  mayGoBack,
} from '@/store/moment/rerun/goBack';
import { useMoment } from '@/store/moment/store';
import { useSource } from '@/store/moment/source';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import classes from './axis.module.css';

/** A button that takes world and program back to the shown moment, where that is possible. */
export function GoBackButton() {
  // What `canGoBack` asks for.
  useMoment((state) => state.t === null);
  useSource();
  const isOffered = useSessionStore(canGoBack);
  return useSessionStore(mayGoBack) ? (
    <AxisButton
      isOffered={isOffered}
      command="time.goBack"
      words="goBack"
      testId="axis-go-back"
      icon={<IconArrowBackUp size={14} />}
    />
  ) : null;
}

/** A button that lets the run continue with the tree as it is now: from the shown moment, or from its pause. */
export function RunOnButton() {
  // What `canRunOn` asks for.
  useMoment((state) => state.t === null);
  useSource();
  useRunStore((state) => state.stage);
  const isOffered = useSessionStore(canRunOn);
  return useSessionStore(mayGoBack) || isOffered ? (
    <AxisButton
      isOffered={isOffered}
      command="time.runOn"
      words="runOn"
      testId="axis-run-on"
      icon={<IconArrowForwardUp size={14} />}
    />
  ) : null;
}

interface AxisButtonProps {
  /** A button that is not offered keeps its place: the axis stays as wide while somebody drags on it. */
  readonly isOffered: boolean;
  readonly command: string;
  readonly words: 'goBack' | 'runOn';
  readonly testId: string;
  readonly icon: ReactNode;
}

function AxisButton({ isOffered, command: id, words, testId, icon }: AxisButtonProps) {
  const { t } = useTranslation('axis');
  const command = useCommandTable(({ commands }) => commands[id]);
  useMoment((state) => state.t);
  const byHand = useSessionStore(changedByHandAt);
  const isLive = useSessionStore(beginsAgain);
  if (!command) return null;
  const help = isLive ? t('goBack.helpLive') : t(`${words}.help`);
  const why = byHand === null ? null : t('goBack.byHand', { t: byHand.toFixed(2) });
  return (
    <Tooltip
      label={why ?? `${help} (${keysOf(command)})`}
      multiline
      w={280}
      events={{ hover: true, focus: why !== null, touch: why !== null }}
    >
      <Button
        size="compact-xs"
        variant="default"
        className={classes['goBack']}
        style={isOffered || why !== null ? undefined : { visibility: 'hidden' }}
        // The button stays focusable, so that its tooltip can say why it is disabled.
        data-disabled={why !== null}
        aria-disabled={why !== null}
        aria-label={t(`${words}.label`)}
        leftSection={icon}
        data-testid={testId}
        onClick={() => perform(id)}
      >
        <span className={classes['goBackText']}>{t(`${words}.label`)}</span>
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
