import { Button, Group, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useShallow } from 'zustand/react/shallow';
import { useProjectStore } from '@/store/project';
import { largePaths, loadAllLarge, useLargeFiles } from '@/store/saving/large';

/** Loads the files that did not come with the project, before they are searched; this can be cancelled. */
export function LargeFiles() {
  const { t } = useTranslation('search');
  const paths = useProjectStore(useShallow((state) => largePaths(state.files)));
  const failed = useLargeFiles((state) => state.failed);
  const [isStopped, setStopped] = useState(false);
  const [total, setTotal] = useState(paths.length);
  const isLoading = paths.length > 0 && !isStopped;

  useEffect(() => {
    if (!isLoading) return;
    const stop = new AbortController();
    void loadAllLarge(stop.signal).then(() => {
      if (!stop.signal.aborted) setStopped(true);
    });
    return () => stop.abort();
  }, [isLoading]);

  if (paths.length > total) setTotal(paths.length);
  if (paths.length === 0) return null;
  const isOffline = paths.some((path) => failed[path]?.isOffline);
  const text = isLoading
    ? t('large.loading', { done: total - paths.length, count: total })
    : t(isOffline ? 'large.offline' : 'large.left', { count: paths.length });
  return (
    <Group gap="xs" px="sm" data-testid="search-large">
      <Text size="xs" c="dimmed" role="status">
        {text}
      </Text>
      <Button size="compact-xs" variant="default" onClick={() => setStopped(isLoading)}>
        {t(isLoading ? 'large.cancel' : 'large.load')}
      </Button>
    </Group>
  );
}
