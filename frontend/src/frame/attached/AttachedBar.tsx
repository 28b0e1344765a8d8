import { ActionIcon, Anchor, Badge, Button, Group, Switch, Text, Tooltip } from '@mantine/core';
import { IconDeviceFloppy, IconPlugConnectedX, IconRobot } from '@tabler/icons-react';
import type { MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { UserMenu } from '@/features/accounts/UserMenu';
import { useProjectStore } from '@/store/project';
import { navigate } from '@/store/route';
import { useSessionStore } from '@/store/session/store';
import { Logo } from '@/ui/Logo';
import { ThemeToggle } from '@/ui/ThemeToggle';
import classes from '../frame.module.css';
import { detach, saveAsProject, setControl } from './commands';

/** The top bar of a page that follows a program: the switch for control, *Save as project* and *Detach*. */
export function AttachedBar() {
  const { t } = useTranslation('attached');
  const { t: ofFrame } = useTranslation('frame');
  const name = useProjectStore((state) => state.name);
  const controls = useSessionStore((state) => state.attached?.controls ?? false);
  const isDriver = useSessionStore((state) => state.introspection?.role === 'driver');
  const isFollowing = useSessionStore(
    ({ executor }) => executor.startsWith('application') || executor === 'held',
  );
  const goHome = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey) return;
    event.preventDefault();
    navigate('/');
  };
  return (
    <header className={classes['topBar']}>
      <Group gap={8} wrap="nowrap" className={classes['where']}>
        <Anchor
          href="/"
          onClick={goHome}
          aria-label={ofFrame('toProjects')}
          title={ofFrame('toProjects')}
          lh={0}
        >
          <Logo size={26} />
        </Anchor>
        <Text component="h1" fw={600} m={0} truncate="end" title={name}>
          {name}
        </Text>
        <Badge variant="light" leftSection={<IconRobot size={13} />} tt="none" style={{ flexShrink: 0 }}>
          {t('badge')}
        </Badge>
      </Group>
      <Group gap={12} wrap="nowrap" className={classes['controls']}>
        <Tooltip label={t('controlHint')} multiline maw={340}>
          <div>
            <Switch
              label={t('control')}
              checked={controls}
              disabled={!isDriver || !isFollowing}
              data-testid="attached-control"
              onChange={({ currentTarget }) => void setControl(currentTarget.checked)}
            />
          </div>
        </Tooltip>
        <Button
          size="xs"
          h={32}
          variant="default"
          leftSection={<IconDeviceFloppy size={15} />}
          data-testid="attached-save"
          onClick={() => void saveAsProject()}
        >
          {t('save')}
        </Button>
        <Tooltip label={`${t('detach')}. ${t('detachHint')}`} multiline maw={340}>
          <ActionIcon
            size="lg"
            aria-label={t('detach')}
            data-testid="attached-detach"
            onClick={() => void detach()}
          >
            <IconPlugConnectedX size={19} />
          </ActionIcon>
        </Tooltip>
      </Group>
      <Group gap={2} wrap="nowrap" className={classes['right']}>
        <ThemeToggle />
        <UserMenu />
      </Group>
    </header>
  );
}
