import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { sendFlag, type FlagDraft } from '@/store/moment/flags';
import { undoNotification } from '@/ui/undoNotification';

const tell = (error: Error) => void notifications.show({ color: 'red', message: error.message });

/** Removes a flag, and offers to set it again. */
export function removeFlag(flag: FlagDraft, user: string): void {
  const undo = () => void sendFlag({ ...flag, id: '' }, user).catch(tell);
  sendFlag({ ...flag, text: '' })
    .then(() =>
      undoNotification({
        message: t('axis:flag.removed', { text: flag.text, t: flag.t.toFixed(2) }),
        undoLabel: t('axis:flag.undo'),
        undo,
      }),
    )
    .catch(tell);
}
