import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { lazyPart } from '@/ui/parts';
import { closeUniverseChooser, useUniverseChooser } from '@/store/dialogs/universeChooser';

const Chooser = lazyPart(async () => (await import('./UniverseChooser')).UniverseChooser);

/** The dialogue that chooses the universe and the robot. */
export function UniverseDialog() {
  const { t } = useTranslation('universe');
  const isOpen = useUniverseChooser((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeUniverseChooser}
      title={t('title')}
      size={960}
      closeButtonProps={{ 'aria-label': t('close') }}
    >
      {isOpen ? (
        <Suspense fallback={null}>
          <Chooser />
        </Suspense>
      ) : null}
    </Modal>
  );
}
