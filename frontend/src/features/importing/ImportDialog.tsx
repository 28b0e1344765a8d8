import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { closeImporting, useImporting } from '@/store/dialogs/importing';
import { lazyPart } from '@/ui/parts';

const Contents = lazyPart(async () => (await import('./ImportContents')).ImportContents);

/** The dialogue that imports a robot or a world into the project. */
export function ImportDialog({ projectId }: { readonly projectId: string }) {
  const { t } = useTranslation('importing');
  const { isOpen, kind, count, finished } = useImporting();
  const title = finished === null ? t(`title.${kind ?? 'any'}`) : t('importReport:title', { file: finished });
  return (
    <Modal
      opened={isOpen}
      onClose={closeImporting}
      title={title}
      size={760}
      closeOnClickOutside={false}
      closeButtonProps={{ 'aria-label': t('close') }}
    >
      {isOpen ? (
        <Suspense fallback={null}>
          <Contents key={count} projectId={projectId} />
        </Suspense>
      ) : null}
    </Modal>
  );
}
