import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';

/** Notifies the user of loaded files that another tab or user has saved. */
export function notifyRemoteSave(paths: readonly string[], { message }: { readonly message: string }): void {
  const names = paths.map((path) => path.split('/').at(-1) ?? path);
  const files = names.length > 3 ? `${names.slice(0, 3).join(', ')} …` : names.join(', ');
  notifications.show({
    id: 'remote-revision',
    title: t('code:remote.title'),
    message: t('code:remote.text', { files, message }),
  });
}
