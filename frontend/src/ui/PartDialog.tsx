import { Modal } from '@mantine/core';
import { type ReactNode, Suspense } from 'react';

interface PartDialogProps {
  isOpen: boolean;
  onClose: () => void;
  title: string;
  closeLabel: string;
  children: ReactNode;
}

/** A large dialogue whose contents load when it opens first (`lazyPart`). */
export function PartDialog({ isOpen, onClose, title, closeLabel, children }: PartDialogProps) {
  return (
    <Modal
      opened={isOpen}
      onClose={onClose}
      title={title}
      size="xl"
      closeButtonProps={{ 'aria-label': closeLabel }}
    >
      {isOpen ? <Suspense fallback={null}>{children}</Suspense> : null}
    </Modal>
  );
}
