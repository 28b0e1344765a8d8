import { ActionIcon, Button, NativeSelect, Tooltip } from '@mantine/core';
import { IconLink, IconPlayerPause, IconPlayerPlay } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { RecordingStopped } from '@/generated/messages';
import { lookNow, setPlaying } from '@/store/moment/looking';
import { useExtent } from '@/store/moment/useExtent';
import { unrecorded } from '@/store/moment/flags';
import { useSource } from '@/store/moment/source';
import { PLAY_SPEEDS, useMoment } from '@/store/moment/store';
import { liveSource } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';
import classes from './axis.module.css';
import { copyShownLink } from './commands';
import { AxisMenu } from './AxisMenu';
import { Changes } from './Changes';
import { FlagForm } from './FlagForm';
import { Marks } from './Marks';
import { RunSelect } from './RunSelect';
import { Strip } from './Strip';

/** A line about a run of which nothing could be recorded. */
function Unrecorded({ stop }: { readonly stop: RecordingStopped }) {
  const { t } = useTranslation('axis');
  return (
    <p className={classes['unrecorded']} role="status" data-testid="axis-unrecorded">
      {t('stopped.nothing', { detail: stop.detail })} {t(`stopped.${stop.reason}`)}
    </p>
  );
}

/** The time axis of the recorded run, below everything. */
export function TimeAxis() {
  const { t } = useTranslation('axis');
  const source = useSource((state) => state.source);
  const kept = useSource((state) => state.kept);
  const extent = useExtent();
  const moment = useMoment((state) => state.t);
  const shown = useMoment((state) => state.shown);
  const isPlaying = useMoment((state) => state.isPlaying);
  const speed = useMoment((state) => state.speed);
  const failure = useMoment((state) => state.failure);
  const missing = useSessionStore(unrecorded);
  if (!extent || extent.to <= extent.from) return missing ? <Unrecorded stop={missing} /> : null;
  const isBack = moment !== null;
  const play = t(isPlaying ? 'pause' : 'play');
  return (
    <>
      <Changes end={extent.to} />
      <Marks extent={extent} />
      <FlagForm />
      {missing && <Unrecorded stop={missing} />}
      <section
        className={classes['axis']}
        aria-label={t('label')}
        data-testid="time-axis"
        data-past={isBack || undefined}
        data-t={moment?.toFixed(3)}
        data-shown={shown?.t.toFixed(3)}
      >
        <Tooltip label={play}>
          <ActionIcon aria-label={play} data-testid="axis-play" onClick={() => setPlaying(!isPlaying)}>
            {isPlaying ? <IconPlayerPause size={16} /> : <IconPlayerPlay size={16} />}
          </ActionIcon>
        </Tooltip>
        <NativeSelect
          size="xs"
          className={classes['speed']}
          aria-label={t('speed')}
          value={String(speed)}
          data={PLAY_SPEEDS.map((each) => ({ value: String(each), label: `×${each}` }))}
          onChange={({ currentTarget }) => useMoment.setState({ speed: Number(currentTarget.value) })}
        />
        <RunSelect run={extent.run} />
        <Strip extent={extent} />
        <AxisMenu />
        <span className={classes['note']} role="status">
          {failure ? (
            <span className={classes['failure']} title={failure}>
              {failure}
            </span>
          ) : isBack && !shown ? (
            t('reading')
          ) : isBack ? (
            <span className={classes['back']} title={t('backHelp')}>
              {kept ? t('kept', { name: kept.name }) : t(source === liveSource ? 'back' : 'earlier')}
            </span>
          ) : null}
        </span>
        <span className={classes['time']} data-testid="axis-time">
          {isBack ? `${moment.toFixed(2)} / ${extent.to.toFixed(1)} s` : `${extent.to.toFixed(1)} s`}
        </span>
        {isBack ? (
          <Tooltip label={t('link.copy')}>
            <ActionIcon aria-label={t('link.copy')} data-testid="axis-link" onClick={copyShownLink}>
              <IconLink size={16} />
            </ActionIcon>
          </Tooltip>
        ) : null}
        <CommandButton command="tests.moment" size={26} testId="axis-test" />
        <Tooltip label={`${t('toLive')} (Esc)`} disabled={!isBack}>
          <Button
            size="compact-xs"
            className={classes['live']}
            variant={isBack ? 'filled' : 'default'}
            disabled={!isBack}
            data-testid="axis-live"
            onClick={lookNow}
          >
            {t('live')}
          </Button>
        </Tooltip>
      </section>
    </>
  );
}
