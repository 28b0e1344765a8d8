import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { lazyPart } from '@/ui/parts';
import { closeExportDialog, useExportDialog } from '@/store/dialogs/export';

const Contents = lazyPart(async () => (await import('./ExportContents')).ExportContents);

/** A dialogue with the contents of an export before the download. */
export function ExportDialog() {
  const { t } = useTranslation('export');
  const isOpen = useExportDialog((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeExportDialog}
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
