import { Anchor, Divider, Group, Text } from '@mantine/core';
import { IconChevronRight } from '@tabler/icons-react';
import type { MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { useUndoTarget } from '@/commands/undo';
import { ReadOnlyBadge } from '@/features/accounts/ReadOnlyBadge';
import { ShareButton } from '@/features/accounts/ShareButton';
import { UserMenu } from '@/features/accounts/UserMenu';
import { RunControls } from '@/features/run/RunControls';
import { useProjectStore } from '@/store/project';
import { navigate } from '@/store/route';
import { Logo } from '@/ui/Logo';
import { ThemeToggle } from '@/ui/ThemeToggle';
import { CommandButton } from '@/ui/CommandButton';
import classes from './frame.module.css';
import { MoreMenu } from './MoreMenu';
import { SaveIndicator } from './SaveIndicator';

export function TopBar() {
  const { t } = useTranslation('frame');
  const name = useProjectStore((state) => state.name);
  const role = useProjectStore((state) => state.role);
  const activeTree = useProjectStore((state) => state.activeTree);
  const canUndo = useProjectStore(({ histories, activeTree }) =>
    Boolean(histories[activeTree ?? '']?.past.length),
  );
  const canRedo = useProjectStore(({ histories, activeTree }) =>
    Boolean(histories[activeTree ?? '']?.future.length),
  );
  const target = useUndoTarget((state) => state.target);
  const goHome = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey) return;
    event.preventDefault();
    navigate('/');
  };
  return (
    <header className={classes['topBar']}>
      <Group gap={8} wrap="nowrap" className={classes['where']}>
        <Anchor href="/" onClick={goHome} aria-label={t('toProjects')} title={t('toProjects')} lh={0}>
          <Logo size={26} />
        </Anchor>
        <Text component="h1" fw={600} m={0} truncate="end" title={name}>
          {name}
        </Text>
        {activeTree ? (
          <Group gap={4} wrap="nowrap" className={classes['crumb']}>
            <IconChevronRight size={14} aria-hidden="true" />
            <Text size="sm" c="dimmed" truncate="end">
              {activeTree}
            </Text>
          </Group>
        ) : null}
        {role === 'viewer' ? <ReadOnlyBadge /> : <SaveIndicator />}
      </Group>
      <Group gap={4} wrap="nowrap" className={classes['controls']}>
        <CommandButton command="edit.undo" testId="undo" isDisabled={!(target?.canUndo ?? canUndo)} />
        <CommandButton command="edit.redo" testId="redo" isDisabled={!(target?.canRedo ?? canRedo)} />
        <Divider orientation="vertical" mx={4} my={8} />
        <RunControls />
      </Group>
      <Group gap={2} wrap="nowrap" className={classes['right']}>
        <CommandButton command="project.takeAway" testId="open-take-away" />
        <ShareButton />
        <ThemeToggle />
        <MoreMenu />
        <UserMenu />
      </Group>
    </header>
  );
}
