import { Alert } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useMe } from './useMe';

/** The warning of a server that runs the Python of all its users with its own rights. */
export function SharedRightsNotice() {
  const { t } = useTranslation('accounts');
  if (!useMe()?.users_run_as_server) return null;
  return (
    <Alert
      variant="default"
      role="note"
      icon={<IconAlertTriangle size={18} color="var(--bts-warning)" aria-hidden="true" />}
      title={t('sharedRights.title')}
      data-testid="shared-rights"
    >
      {t('sharedRights.note')}
    </Alert>
  );
}
