import { ActionIcon, Button, NativeSelect, Tooltip } from '@mantine/core';
import { IconLink, IconPlayerPause, IconPlayerPlay } from '@tabler/icons-react';
import { useLayoutEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { RecordingStopped } from '@/generated/messages';
import { lookNow, setPlaying, type Extent } from '@/store/moment/looking';
import { useExtent } from '@/store/moment/useExtent';
import { unrecorded } from '@/store/moment/flags';
import { useSource } from '@/store/moment/source';
import { PLAY_SPEEDS, useIsBack, useMoment } from '@/store/moment/store';
import { liveSource } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import { useIsBasic } from '@/store/viewMode';
import { CommandButton } from '@/ui/CommandButton';
import classes from './axis.module.css';
import { copyShownLink } from './commands';
import { AxisMenu } from './AxisMenu';
import { BranchForm } from './branches/BranchForm';
import { Changes } from './Changes';
import { Compared } from './branches/Compared';
import { FlagForm } from './FlagForm';
import { GoBackButton, GoingBack, RunOnButton } from './GoingBack';
import { Marks } from './Marks';
import { PastActions } from './PastActions';
import { RunSelect } from './branches/RunSelect';
import { Strip } from './Strip';

/** The length in s that the axis has at least. */
const SHORTEST_S = 0.05;

/** A line about a run of which nothing could be recorded. */
function Unrecorded({ stop }: { readonly stop: RecordingStopped }) {
  const { t } = useTranslation('axis');
  return (
    <p className={classes['unrecorded']} role="status" data-testid="axis-unrecorded">
      {t('stopped.nothing', { detail: stop.detail })} {t(`stopped.${stop.reason}`)}
    </p>
  );
}

/** Writes the wanted and the shown time on the axis; they change often, and it is not rendered for them. */
function useTimesOn() {
  const ref = useRef<HTMLElement>(null);
  useLayoutEffect(() => {
    const put = () => {
      const { t, shown } = useMoment.getState();
      const data = ref.current?.dataset;
      if (!data) return;
      for (const [name, time] of [
        ['t', t],
        ['shown', shown?.t ?? null],
      ] as const) {
        if (time === null) delete data[name];
        else data[name] = time.toFixed(3);
      }
    };
    put();
    return useMoment.subscribe(put);
  }, []);
  return ref;
}

/** The time axis of the recorded run, below everything. */
export function TimeAxis() {
  const extent = useExtent();
  const missing = useSessionStore(unrecorded);
  const isBranch = useSessionStore(({ branches }) => branches.some(({ run }) => run === extent?.run));
  if (!extent || (extent.to <= extent.from && !isBranch)) {
    return (
      <>
        <GoingBack />
        {missing ? <Unrecorded stop={missing} /> : null}
      </>
    );
  }
  return (
    <>
      <GoingBack />
      <Changes end={extent.to} />
      <Compared />
      <Marks extent={extent} />
      <FlagForm />
      <BranchForm />
      {missing && <Unrecorded stop={missing} />}
      {/* A branch that has not run on yet has a length, too, so that one can look at the run before. */}
      <Axis extent={{ ...extent, to: Math.max(extent.to, extent.from + SHORTEST_S) }} />
    </>
  );
}

function Axis({ extent }: { readonly extent: Extent }) {
  const { t } = useTranslation('axis');
  const isBack = useIsBack();
  // An attached session has no address that others could open.
  const hasLink = useSessionStore((state) => state.attached === null);
  const isPlaying = useMoment((state) => state.isPlaying);
  const speed = useMoment((state) => state.speed);
  const axis = useTimesOn();
  const play = t(isPlaying ? 'pause' : 'play');
  // They keep their place, so that the strip does not move below the pointer that takes it to the past.
  const isQuiet = useIsBasic() && !isBack;
  return (
    <section
      ref={axis}
      className={classes['axis']}
      aria-label={t('label')}
      data-testid="time-axis"
      data-past={isBack || undefined}
      data-quiet={isQuiet || undefined}
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
      <div className={classes['extra']}>
        <AxisMenu />
      </div>
      <Note />
      <Clock end={extent.to} />
      {hasLink ? (
        <Tooltip label={t('link.copy')}>
          <ActionIcon
            aria-label={t('link.copy')}
            className={classes['link']}
            style={isBack ? undefined : { visibility: 'hidden' }}
            data-testid="axis-link"
            onClick={copyShownLink}
          >
            <IconLink size={16} />
          </ActionIcon>
        </Tooltip>
      ) : null}
      <PastActions />
      <GoBackButton />
      <RunOnButton />
      <div className={classes['extra']}>
        <CommandButton command="tests.moment" size={26} testId="axis-test" />
      </div>
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
  );
}

/** What is shown: the recording, or why it cannot be read. */
function Note() {
  const { t } = useTranslation('axis');
  const isBack = useIsBack();
  const isRead = useMoment((state) => state.shown !== null);
  const failure = useMoment((state) => state.failure);
  const source = useSource((state) => state.source);
  const kept = useSource((state) => state.kept);
  return (
    <span className={classes['note']} role="status">
      {failure ? (
        <span className={classes['failure']} title={failure}>
          {failure}
        </span>
      ) : isBack && !isRead ? (
        t('reading')
      ) : isBack ? (
        <span
          className={classes['back']}
          title={kept ? `${t('kept', { name: kept.name })} ${t('backHelp')}` : t('backHelp')}
        >
          {kept ? t('kept', { name: kept.name }) : t(source === liveSource ? 'back' : 'earlier')}
        </span>
      ) : null}
    </span>
  );
}

function Clock({ end }: { readonly end: number }) {
  const moment = useMoment((state) => state.t);
  return (
    <span className={classes['time']} data-testid="axis-time">
      {moment === null ? `${end.toFixed(1)} s` : `${moment.toFixed(2)} / ${end.toFixed(1)} s`}
    </span>
  );
}
