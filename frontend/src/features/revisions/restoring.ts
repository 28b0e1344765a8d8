import { notifications } from '@mantine/notifications';
import { reasonOf } from '@/api/reason';
import { t } from '@/i18n';
import { undoNotification } from '@/ui/undoNotification';
import { restoreRevision } from '@/store/revisions/restore';

/** Restores files (all, if none are named) from a revision; a notification offers to undo this. */
export async function restore(number: number, paths: readonly string[]): Promise<void> {
  try {
    const { previous, isChanged } = await restoreRevision(number, paths);
    if (!isChanged) {
      notifications.show({ message: t('revisions:alreadySo', { number }) });
      return;
    }
    undoNotification({
      message: t('revisions:restored', { number }),
      undoLabel: t('revisions:undo'),
      undo: () => void restore(previous, paths),
    });
  } catch (error) {
    const message = reasonOf(error);
    notifications.show({ color: 'red', title: t('revisions:restoreFailed'), message });
  }
}
