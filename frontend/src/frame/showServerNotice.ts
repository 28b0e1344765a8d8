import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';

const ID = 'server-notice';

/** Says what the server tells all its users, until it is over or read; the words are the administrator's. */
export function showServerNotice(text: string): void {
  notifications.hide(ID);
  if (text) {
    notifications.show({
      id: ID,
      color: 'yellow',
      autoClose: false,
      title: t('frame:serverNotice'),
      message: text,
    });
  }
}
