import { Button, Stack, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { showPanel } from '@/workspace/tabs';

interface RemoteSave {
  readonly message: string;
  /** How many of the user's own steps can no longer be undone or done again. */
  readonly lost?: number;
}

/** Notifies the user of loaded files that another tab or user has saved, and of steps that it made impossible. */
export function notifyRemoteSave(paths: readonly string[], { message, lost = 0 }: RemoteSave): void {
  const names = paths.map((path) => path.split('/').at(-1) ?? path);
  const files = names.length > 3 ? `${names.slice(0, 3).join(', ')} …` : names.join(', ');
  const text = t('code:remote.text', { files, message });
  const id = 'remote-revision';
  const showHistory = () => {
    notifications.hide(id);
    showPanel('history');
  };
  notifications.hide(id); // a notification that is still shown would stay as it is
  notifications.show({
    id,
    title: t('code:remote.title'),
    ...(lost > 0 ? { autoClose: 20_000 } : {}),
    message:
      lost === 0 ? (
        text
      ) : (
        <Stack gap={6} align="flex-start">
          <Text size="sm">{text}</Text>
          <Text size="sm">{t('code:remote.lost', { count: lost })}</Text>
          <Button size="compact-sm" variant="light" onClick={showHistory}>
            {t('code:remote.history')}
          </Button>
        </Stack>
      ),
  });
}
