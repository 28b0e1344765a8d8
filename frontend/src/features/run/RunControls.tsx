import { Button, Divider, Group, Tooltip } from '@mantine/core';
import { IconPlayerPlayFilled } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { shortcutLabel } from '@/commands/shortcuts';
import { ActionButton } from '@/ui/CommandButton';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { ExecutorState } from './ExecutorState';
import { RunMenu } from './RunMenu';
import { useHindrance } from './useRunBlocker';
import { RateSelects } from './RateSelects';
import classes from './run.module.css';
import { useHasChanged } from './useHasChanged';

/** Run, and what can be done with what runs. */
export function RunControls() {
  const { t } = useTranslation('run');
  const stage = useRunStore((state) => state.stage);
  const executor = useSessionStore((state) => state.executor);
  const connection = useSessionStore((state) => state.connection);
  const isRunning = executor === 'application_running';
  const isPaused = executor === 'paused';
  const hasApplication = isRunning || isPaused;
  const hindrance = useHindrance();
  const isHindered = hindrance !== null;
  const hasChanged = useHasChanged();
  const help = hasApplication ? (hasChanged ? 'changedHelp' : 'runAgainHelp') : 'runHelp';
  const runLabel = t(hasApplication ? 'runAgain' : 'action.run');

  return (
    <Group gap={4} wrap="nowrap">
      <Tooltip
        label={hindrance ? t(`hindrance.${hindrance}`) : `${t(help)} (${shortcutLabel('F5')})`}
        multiline
        maw={340}
        events={{ hover: true, focus: isHindered, touch: isHindered }}
      >
        <Button
          className={classes['runButton']}
          size="xs"
          h={32}
          px={14}
          leftSection={<IconPlayerPlayFilled size={15} />}
          variant={hasApplication && !hasChanged ? 'light' : 'filled'}
          loading={stage !== null}
          // It stays in the order of the keyboard, and can be asked why it does nothing.
          data-disabled={isHindered}
          aria-disabled={isHindered}
          data-testid="run"
          onClick={() => perform('run.run')}
        >
          {runLabel}
        </Button>
      </Tooltip>
      {isPaused ? (
        <ActionButton action="run.resume" testId="resume" isDisabled={isHindered} />
      ) : (
        <ActionButton action="run.pause" testId="pause" isDisabled={!isRunning || isHindered} />
      )}
      <ActionButton action="run.step" testId="step" isDisabled={!hasApplication || isHindered} />
      <RunMenu isDisabled={isHindered} />
      <ActionButton action="run.stop" testId="stop" isDisabled={!hasApplication || isHindered} />
      <ActionButton action="run.end" testId="end-session" isDisabled={connection === 'off' || isHindered} />
      <Divider orientation="vertical" mx={4} my={8} className={classes['rates']} />
      <div className={classes['rates']}>
        <RateSelects />
      </div>
      <ExecutorState />
    </Group>
  );
}
