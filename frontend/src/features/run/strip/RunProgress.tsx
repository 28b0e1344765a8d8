import { Button, Progress, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { Rung } from '@/generated/messages';
import { cancelRun } from '@/store/run/run';
import { useRunStore, type LaunchStage } from '@/store/run/store';
import { openOwnRobots } from '@/store/dialogs/ownRobots';
import { useSessionStore } from '@/store/session/store';
import type { QueuedTurn } from '@/store/session/types';
import classes from './strip.module.css';

const STAGES: LaunchStage[] = ['saving', 'checking', 'starting', 'launching'];
const RUNGS: Rung[] = ['connect', 'launch_universe', 'prepare_visualization', 'run_application'];

/** The part of the bar for the steps before the executor's own; the executor's rungs fill the rest. */
const BEFORE = 0.2;

export function fractionOf(stage: LaunchStage, rung: Rung | undefined, fraction: number): number {
  if (stage === 'applying') return 2 / 3; // saving and checking are done
  if (stage !== 'launching') return (BEFORE * (STAGES.indexOf(stage) + 1)) / STAGES.length;
  const index = rung ? RUNGS.indexOf(rung) : 0;
  return BEFORE + ((1 - BEFORE) * (index + fraction)) / RUNGS.length;
}

/** Returns the text for the turn of a session that waits for a place on the server. */
const turnKey = ({ before, isOwn }: QueuedTurn) =>
  isOwn ? 'queued.own' : before === 0 ? 'queued.next' : 'queued.before';

/** A progress bar from Run to a moving robot, or to a changed tree, with the current step. */
export function RunProgress() {
  const { t } = useTranslation(['run', 'axis']);
  const stage = useRunStore((state) => state.stage);
  const progress = useSessionStore((state) => state.progress);
  const queued = useSessionStore((state) => state.queued);
  const isGoingBack = useSessionStore((state) => state.goingBack !== null);
  if (!stage) return null;
  const canCancel = stage === 'launching' || stage === 'starting';
  const rung = stage === 'launching' ? progress?.rung : undefined;
  const name = queued
    ? t(turnKey(queued), { count: queued.before })
    : rung
      ? t(`rung.${rung}`)
      : isGoingBack
        ? t('axis:goBack.going')
        : t(`stage.${stage}`);
  const percent = 100 * fractionOf(stage, rung, progress?.fraction ?? 0);
  const text = canCancel && !queued ? progress?.message : '';
  return (
    <div className={classes['progress']} role="status" data-testid="run-progress">
      <Progress value={percent} size="xs" radius={0} transitionDuration={200} aria-label={name} />
      <div className={classes['progressText']}>
        <Text size="xs" fw={600}>
          {name}
        </Text>
        <Text size="xs" c="dimmed" truncate="end">
          {text}
        </Text>
        {queued ? (
          <Button size="compact-xs" variant="light" onClick={openOwnRobots}>
            {t('command.mine')}
          </Button>
        ) : null}
        {canCancel ? (
          <Button size="compact-xs" variant="subtle" color="gray" onClick={cancelRun}>
            {t('cancel')}
          </Button>
        ) : null}
      </div>
    </div>
  );
}
