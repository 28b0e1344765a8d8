import { Button, Divider, Group, Tooltip } from '@mantine/core';
import { IconPlayerPlayFilled } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { shortcutLabel } from '@/commands/shortcuts';
import { CommandButton } from '@/ui/CommandButton';
import { usePressed } from '@/ui/hooks/usePressed';
import { TickBackButton } from './TickBackButton';
import { useRunStore } from '@/store/run/store';
import { doesWorldRunAlone } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';
import { useIsBasic } from '@/store/viewMode';
import { ExecutorState } from './ExecutorState';
import { RunMenu } from './RunMenu';
import { useRunBlocker } from './useRunBlocker';
import { RateSelects, TimeChip } from './RateSelects';
import classes from './run.module.css';
import { useHasChanged } from './useHasChanged';

/** The Run button, and the commands for a running application. */
export function RunControls() {
  const { t } = useTranslation('run');
  const stage = useRunStore((state) => state.stage);
  const executor = useSessionStore((state) => state.executor);
  const connection = useSessionStore((state) => state.connection);
  const isRunning = executor === 'application_running';
  const isPaused = executor === 'paused';
  const isHeld = executor === 'held';
  const isGoingBack = useSessionStore((state) => state.goingBack !== null);
  const hasApplication = isRunning || isPaused || isHeld;
  const worldRuns = useSessionStore(doesWorldRunAlone);
  const runBlocker = useRunBlocker();
  const isBlocked = runBlocker !== null;
  // A robot can be stopped while its past is shown.
  const mayStop = !isBlocked || runBlocker === 'past';
  const hasChanged = useHasChanged();
  const { isPressed, handlers } = usePressed();
  const isBasic = useIsBasic();

  return (
    <Group gap={4} wrap="nowrap">
      <Tooltip
        label={runBlocker ? t(`runBlocker.${runBlocker}`) : `${t('runHelp')} (${shortcutLabel('F5')})`}
        // The tooltip is disabled after a press, since it would cover the message of the run.
        disabled={isPressed && !isBlocked}
        multiline
        maw={340}
        events={{ hover: true, focus: isBlocked, touch: isBlocked }}
      >
        <Button
          className={classes['runButton']}
          size="xs"
          h={32}
          px={14}
          leftSection={<IconPlayerPlayFilled size={15} />}
          variant={hasApplication && !hasChanged ? 'light' : 'filled'}
          loading={stage !== null}
          // The button stays focusable, so that its tooltip can explain why it is disabled.
          data-disabled={isBlocked}
          aria-disabled={isBlocked}
          data-testid="run"
          onClick={() => perform('run.run')}
          {...handlers}
        >
          {t('command.run')}
        </Button>
      </Tooltip>
      {isBasic ? null : (
        <CommandButton
          command="run.restart"
          testId="restart"
          isDisabled={!(hasApplication || executor === 'visualization_ready') || isBlocked || stage !== null}
        />
      )}
      {isPaused ? (
        <CommandButton command="run.resume" testId="resume" isDisabled={isBlocked || isGoingBack} />
      ) : (
        <CommandButton command="run.pause" testId="pause" isDisabled={!isRunning || isBlocked} />
      )}
      {isBasic && !isPaused ? null : (
        <CommandButton
          command="run.step"
          testId="step"
          isDisabled={!hasApplication || isHeld || isGoingBack || isBlocked}
        />
      )}
      {isBasic ? null : (
        <div className={classes['tickBack']}>
          <TickBackButton />
        </div>
      )}
      <RunMenu isDisabled={isBlocked} />
      <CommandButton
        command="run.stop"
        testId="stop"
        isDisabled={!(hasApplication || worldRuns) || !mayStop}
      />
      {isBasic ? null : (
        <>
          <CommandButton
            command="run.end"
            testId="end-session"
            isDisabled={connection === 'off' || !mayStop}
          />
          <Divider orientation="vertical" mx={4} my={8} className={classes['rates']} />
          <div className={classes['rates']}>
            <RateSelects />
          </div>
        </>
      )}
      <div className={classes['rates']}>
        <TimeChip />
      </div>
      <ExecutorState />
    </Group>
  );
}
