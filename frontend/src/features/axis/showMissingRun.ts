import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import type { Missing } from '@/store/moment/address';

/** Shows the reason why the run of an address is not shown, and the next step. */
export function showMissingRun(missing: Missing): void {
  notifications.show({
    color: missing.what === 'failed' ? 'red' : 'yellow',
    autoClose: false,
    title: t('axis:missing.title'),
    message: missing.what === 'failed' ? missing.reason : t(`axis:missing.${missing.what}`),
  });
}
