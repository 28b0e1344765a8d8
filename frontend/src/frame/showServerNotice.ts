import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';

const ID = 'server-notice';

/** Shows the administrator's notice to all users, until it ends or is closed. */
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
