import { ActionIcon, Anchor, Button, Group, Menu, Text } from '@mantine/core';
import { IconDots } from '@tabler/icons-react';
import { useState, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { MyRun } from '@/api/runs';
import { timeAgo } from '@/i18n/timeAgo';
import { navigate } from '@/store/route';
import { openBeside } from './beside';
import classes from './myRuns.module.css';
import { minutes, pathOf } from './present';
import { ResultBadge } from './ResultBadge';
import { Thumbnail } from './Thumbnail';

interface Props {
  readonly run: MyRun;
  readonly onRemove: () => Promise<boolean>;
}

/** A kept run on the start page; of one whose project is closed to the user only the deletion is left. */
export function MyRunCard({ run, onRemove }: Props) {
  const { t, i18n } = useTranslation('runs');
  const [isAsking, setAsking] = useState(false);
  const name = run.name || t('last');
  const path = pathOf(run);
  const follow = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey || event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    navigate(path);
  };
  return (
    <li className={classes['card']} data-testid={`my-run-${run.id}`}>
      <Thumbnail projectId={run.project} run={run.may_open ? run : { ...run, has_thumbnail: false }} />
      <div className={classes['text']}>
        <Group gap="xs">
          {run.may_open ? (
            <Anchor href={path} onClick={follow} fw={600} c="var(--bts-text)" className={classes['name']}>
              {name}
            </Anchor>
          ) : (
            <Text fw={600} className={classes['name']}>
              {name}
            </Text>
          )}
          <ResultBadge result={run.result} />
        </Group>
        <Text size="xs" c="dimmed">
          {t(run.may_open ? 'mine.facts' : 'mine.closed', {
            length: minutes(run.length_s),
            when: timeAgo(run.created_at, i18n.language),
            project: run.project_name,
          })}
        </Text>
        {run.note ? (
          <Text size="sm" lineClamp={2} className={classes['note']}>
            {run.note}
          </Text>
        ) : null}
        {isAsking ? (
          <Group gap="xs" mt={4} role="alert">
            <Text size="sm">{t('removeSure')}</Text>
            <Button size="compact-sm" variant="default" onClick={() => setAsking(false)}>
              {t('cancel')}
            </Button>
            <Button size="compact-sm" color="red" onClick={() => (setAsking(false), void onRemove())}>
              {t('remove')}
            </Button>
          </Group>
        ) : null}
      </div>
      <Menu position="bottom-end" width={240}>
        <Menu.Target>
          <ActionIcon size="md" aria-label={t('more', { name })}>
            <IconDots size={16} />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          {run.may_open ? <Menu.Item onClick={() => openBeside(path)}>{t('mine.beside')}</Menu.Item> : null}
          <Menu.Item color="red" onClick={() => setAsking(true)}>
            {t('remove')}
          </Menu.Item>
        </Menu.Dropdown>
      </Menu>
    </li>
  );
}
