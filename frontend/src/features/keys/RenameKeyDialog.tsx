import { Modal } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { closeRenameKey, useRenameKey } from '@/store/dialogs/renameKey';
import { RenameKeyForm } from './RenameKeyForm';

/** The dialogue that renames a blackboard key wherever it is the same entry. */
export function RenameKeyDialog() {
  const { t } = useTranslation('keys');
  const { isOpen, key } = useRenameKey();
  return (
    <Modal opened={isOpen} onClose={closeRenameKey} title={t('title')} size={620} data-testid="rename-key">
      {isOpen ? <RenameKeyForm start={key} onDone={closeRenameKey} /> : null}
    </Modal>
  );
}
