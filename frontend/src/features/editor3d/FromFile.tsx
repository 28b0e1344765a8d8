import { Button, Group, Text } from '@mantine/core';
import { IconFileImport } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { PartKind } from '@/api/imports';
import { openImporting } from '@/store/dialogs/importing';

interface Props {
  readonly kind: PartKind;
  /** Closes the dialogue that this is in. */
  readonly onLeave: () => void;
}

/** The way from the dialogue of a copy to the import of files. */
export function FromFile({ kind, onLeave }: Props) {
  const { t } = useTranslation('importing');
  return (
    <Group gap="sm" mb="md">
      <Button
        variant="light"
        leftSection={<IconFileImport size={16} />}
        data-testid={`import-${kind}`}
        onClick={() => {
          onLeave();
          openImporting(kind);
        }}
      >
        {t(`fromFile.${kind}`)}
      </Button>
      <Text size="sm" c="dimmed" style={{ flex: 1, minWidth: 180 }}>
        {t('fromFileHint')}
      </Text>
    </Group>
  );
}
