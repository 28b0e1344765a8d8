import { notifications } from '@mantine/notifications';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { useSavingStore } from '@/store/saving/store';

/** A notification that unsaved edits were restored. */
export function RestoredNotice() {
  const { t } = useTranslation('frame');
  const restored = useSavingStore((state) => state.restoredFiles);
  useEffect(() => {
    if (restored === 0) return;
    useSavingStore.setState({ restoredFiles: 0 });
    notifications.show({ message: t('restored', { count: restored }) });
  }, [restored, t]);
  return null;
}
