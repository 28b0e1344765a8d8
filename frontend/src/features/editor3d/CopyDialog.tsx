import { Modal } from '@mantine/core';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';

interface Props {
  readonly title: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** A dialogue that makes a new document from an existing one, with a `CopyForm` inside. */
export function CopyDialog({ title, isOpen, onClose, children }: Props) {
  const { t } = useTranslation('editor3d');
  return (
    <Modal
      opened={isOpen}
      onClose={onClose}
      title={title}
      size={760}
      closeButtonProps={{ 'aria-label': t('copy.cancel') }}
    >
      {isOpen ? children : null}
    </Modal>
  );
}
