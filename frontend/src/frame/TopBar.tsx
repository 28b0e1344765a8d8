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
import { useIsBasic } from '@/store/viewMode';
import { Logo } from '@/ui/Logo';
import { ThemeToggle } from '@/ui/ThemeToggle';
import { CommandButton } from '@/ui/CommandButton';
import { useTabs } from '@/workspace/tabs';
import classes from './frame.module.css';
import { MoreMenu } from './MoreMenu';
import { SaveIndicator } from './SaveIndicator';

export function TopBar() {
  const { t } = useTranslation('frame');
  const name = useProjectStore((state) => state.name);
  const role = useProjectStore((state) => state.role);
  const activeTree = useProjectStore((state) => state.activeTree);
  const front = useTabs((state) => state.front);
  const shown = front !== null && 'path' in front ? front.path : activeTree;
  const canUndo = useProjectStore(({ histories, activeTree }) =>
    Boolean(histories[activeTree ?? '']?.past.length),
  );
  const canRedo = useProjectStore(({ histories, activeTree }) =>
    Boolean(histories[activeTree ?? '']?.future.length),
  );
  const target = useUndoTarget((state) => state.target);
  const undoes = target?.canUndo ?? canUndo;
  const redoes = target?.canRedo ?? canRedo;
  const isQuiet = useIsBasic() && !undoes && !redoes;
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
        <Text component="h1" className={classes['name'] ?? ''} fw={600} m={0} truncate="end" title={name}>
          {name}
        </Text>
        {shown ? (
          <Group gap={4} wrap="nowrap" className={classes['crumb']}>
            <IconChevronRight size={14} aria-hidden="true" />
            <Text size="sm" c="dimmed" truncate="end" title={shown} data-testid="crumb">
              {shown}
            </Text>
          </Group>
        ) : null}
        {role === 'viewer' ? <ReadOnlyBadge /> : <SaveIndicator />}
      </Group>
      <Group gap={4} wrap="nowrap" className={classes['controls']}>
        {/* Their place stays, so that the first edit does not move Run. */}
        <Group gap={4} wrap="nowrap" style={isQuiet ? { visibility: 'hidden' } : undefined}>
          <CommandButton command="edit.undo" testId="undo" isDisabled={!undoes} />
          <CommandButton command="edit.redo" testId="redo" isDisabled={!redoes} />
          <Divider orientation="vertical" mx={4} my={8} />
        </Group>
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
