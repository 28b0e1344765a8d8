import { Button, Center, Loader, Stack, Text } from '@mantine/core';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { loadLarge, useLargeFiles } from '@/store/saving/large';

/** Loads a file whose content did not come with the project; the editor follows when it has arrived. */
export function LargeFile({ path }: { readonly path: string }) {
  const { t } = useTranslation('code');
  const failure = useLargeFiles((state) => state.failed[path]);

  useEffect(() => {
    void loadLarge(path);
  }, [path]);

  return (
    <Center h="100%" data-testid="large-file">
      {failure ? (
        <Stack align="center" gap="xs">
          <Text role="alert">
            {failure.isOffline
              ? t('large.offline', { path })
              : t('large.failed', { path, reason: failure.reason })}
          </Text>
          <Button size="xs" variant="default" onClick={() => void loadLarge(path)}>
            {t('large.retry')}
          </Button>
        </Stack>
      ) : (
        <Loader size="sm" role="status" aria-label={t('large.loading', { path })} />
      )}
    </Center>
  );
}
