import { Modal } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { closeSettings, useSettingsDialog } from '@/store/dialogs/settings';
import { SettingsForm } from './SettingsForm';

/** What a project is called, and how it runs. */
export function Settings() {
  const { t } = useTranslation('settings');
  const isOpen = useSettingsDialog((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeSettings}
      title={t('title')}
      size="md"
      closeButtonProps={{ 'aria-label': t('close') }}
    >
      {isOpen ? <SettingsForm /> : null}
    </Modal>
  );
}
