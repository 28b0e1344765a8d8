import { Alert, Button, Group, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';

interface MakeOwnerProps {
  readonly who: string;
  readonly isBusy: boolean;
  readonly onConfirm: () => void;
  readonly onCancel: () => void;
}

/** A request for confirmation before the project gets another owner. */
export function MakeOwner({ who, isBusy, onConfirm, onCancel }: MakeOwnerProps) {
  const { t } = useTranslation('accounts');
  return (
    <Alert variant="default" role="alert">
      <Text size="sm" mb="sm">
        {t('share.makeOwnerNote', { who })}
      </Text>
      <Group gap={8}>
        <Button size="xs" variant="filled" loading={isBusy} onClick={onConfirm}>
          {t('share.makeOwner', { who })}
        </Button>
        <Button size="xs" variant="default" onClick={onCancel}>
          {t('share.keep')}
        </Button>
      </Group>
    </Alert>
  );
}
