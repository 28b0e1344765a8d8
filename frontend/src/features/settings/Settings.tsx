import { Modal } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { closeSettings, useSettingsDialog } from '@/store/dialogs/settings';
import { SettingsForm } from './SettingsForm';

/** The dialogue for the name of a project, and for its settings for runs. */
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
