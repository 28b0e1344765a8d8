import { Alert, Button, Group, Skeleton, Text, Title } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { LogButton } from './LogButton';
import { MyRunCard } from './MyRunCard';
import classes from './myRuns.module.css';
import { openNewLog } from './openNewLog';
import { useMyRuns } from './useMyRuns';

const FIRST = 6;

/** The runs that the user has kept in all projects, on the start page. */
export function MyRuns() {
  const { t } = useTranslation('runs');
  const { found, remove } = useMyRuns();
  const [isWhole, setWhole] = useState(false);
  const all = found.data ?? [];
  const shown = isWhole ? all : all.slice(0, FIRST);
  return (
    <section aria-labelledby="runs-heading" data-testid="my-runs">
      <Group justify="space-between" mb="md">
        <Title order={2} size={18} id="runs-heading">
          {t('title')}
        </Title>
        <LogButton onOpen={(file) => openNewLog(file, t)} />
      </Group>
      {found.isPending ? <Skeleton height={78} radius="lg" role="status" aria-label={t('loading')} /> : null}
      {found.isError ? (
        <Alert color="red" icon={<IconAlertTriangle />} title={t('listFailed')}>
          <Text size="sm">{found.error.message}</Text>
          <Button mt="sm" size="xs" variant="light" color="red" onClick={() => void found.refetch()}>
            {t('tryAgain')}
          </Button>
        </Alert>
      ) : null}
      {found.isSuccess && all.length === 0 ? <Text c="dimmed">{t('mine.none')}</Text> : null}
      {all.length > 0 ? (
        <ul className={classes['list']} aria-labelledby="runs-heading">
          {shown.map((run) => (
            <MyRunCard key={run.id} run={run} onRemove={() => remove(run.id)} />
          ))}
        </ul>
      ) : null}
      {shown.length < all.length ? (
        <Button mt="md" variant="default" onClick={() => setWhole(true)}>
          {t('mine.more', { count: all.length - shown.length })}
        </Button>
      ) : null}
    </section>
  );
}
