import { Modal } from '@mantine/core';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';

interface Props {
  readonly title: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** The dialogue in which something of the project is made from what is there; it holds a `CopyForm`. */
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
