import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';

const ID = 'server-notice';

/** Shows the administrator's notice until it ends or the user closes it. */
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
