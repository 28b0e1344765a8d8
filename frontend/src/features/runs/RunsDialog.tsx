import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { closeRunsDialog, useRunsDialog } from '@/store/dialogs/runs';
import { lazyPart } from '@/ui/parts';
import { LogDrop } from './LogDrop';

const Contents = lazyPart(async () => (await import('./RunsContents')).RunsContents);

/** A dialogue with the kept runs of the project; a log that is dropped on the page is opened, too. */
export function RunsDialog() {
  const { t } = useTranslation('runs');
  const isOpen = useRunsDialog((state) => state.isOpen);
  return (
    <>
      <LogDrop />
      <Modal
        opened={isOpen}
        onClose={closeRunsDialog}
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
    </>
  );
}
