import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { lazyPart } from '@/ui/parts';
import { closeTakeAway, useTakeAway } from '@/store/dialogs/export';

const Contents = lazyPart(async () => (await import('./ExportContents')).TakeAwayContents);

/** Shows what can be taken along, before it is. */
export function TakeAway() {
  const { t } = useTranslation('export');
  const isOpen = useTakeAway((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeTakeAway}
      title={t('title')}
      size="xl"
      closeButtonProps={{ 'aria-label': t('close') }}
    >
      {isOpen ? (
        <Suspense fallback={null}>
          <Contents />
        </Suspense>
      ) : null}
    </Modal>
  );
}
