import { Badge, Tooltip } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconEye } from '@tabler/icons-react';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';

const NOTE = 'read-only';

/**
 * The badge of a project that the user can only read. When the user tries to change the project, it shows a
 * notification.
 */
export function ReadOnlyBadge() {
  const { t } = useTranslation('accounts');
  const refused = useProjectStore((state) => state.refusedEdits);
  useEffect(() => {
    if (refused > 0)
      notifications.show({
        id: NOTE,
        title: t('readOnly.badge'),
        message: t('readOnly.note'),
        color: 'indigo',
      });
  }, [refused, t]);
  return (
    <Tooltip label={t('readOnly.note')}>
      <Badge
        variant="light"
        leftSection={<IconEye size={13} />}
        tt="none"
        style={{ flexShrink: 0 }}
        data-testid="read-only"
      >
        {t('readOnly.badge')}
      </Badge>
    </Tooltip>
  );
}
