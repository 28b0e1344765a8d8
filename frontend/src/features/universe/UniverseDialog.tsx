import { Modal } from '@mantine/core';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import { lazyPart } from '@/ui/parts';
import { closeWorlds, useWorlds } from '@/store/dialogs/universeChooser';

const Chooser = lazyPart(async () => (await import('./UniverseChooser')).WorldChooser);

/** Where the robot will be, and which robot. */
export function Worlds() {
  const { t } = useTranslation('universe');
  const isOpen = useWorlds((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeWorlds}
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
