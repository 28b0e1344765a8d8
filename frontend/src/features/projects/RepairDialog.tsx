import { Button, Code, Group, Modal, ScrollArea, Table, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { RepairOffer } from './useImport';

interface Props {
  readonly offer: RepairOffer | null;
  readonly onRepair: () => void;
  readonly onClose: () => void;
}

/** A dialogue that asks whether to repair a file on import, and lists each change. */
export function RepairDialog({ offer, onRepair, onClose }: Props) {
  const { t } = useTranslation('projects');
  const changes = offer?.changes ?? [];
  return (
    <Modal opened={offer !== null} onClose={onClose} title={t('repair.title')} size="lg">
      <Text size="sm" mb="md">
        {t('repair.text', { file: offer?.asked.file.name ?? '', count: changes.length })}
      </Text>
      <ScrollArea.Autosize mah="50vh" mb="md">
        <Table aria-label={t('repair.changes')} data-testid="repairs">
          <Table.Thead>
            <Table.Tr>
              <Table.Th>{t('repair.line')}</Table.Th>
              <Table.Th>{t('repair.value')}</Table.Th>
              <Table.Th>{t('repair.change')}</Table.Th>
            </Table.Tr>
          </Table.Thead>
          <Table.Tbody>
            {changes.map(({ line, column, values }) => (
              <Table.Tr key={`${String(line)}:${String(column)}`}>
                <Table.Td>{line}</Table.Td>
                <Table.Td style={{ wordBreak: 'break-word' }}>
                  <Code>{values?.['value']}</Code>
                </Table.Td>
                <Table.Td style={{ whiteSpace: 'nowrap' }}>
                  <Code>{values?.['before']}</Code> → <Code>{values?.['after']}</Code>
                </Table.Td>
              </Table.Tr>
            ))}
          </Table.Tbody>
        </Table>
      </ScrollArea.Autosize>
      <Group justify="end">
        <Button variant="default" onClick={onClose}>
          {t('repair.decline')}
        </Button>
        <Button onClick={onRepair} data-testid="repair" data-autofocus>
          {t('repair.accept')}
        </Button>
      </Group>
    </Modal>
  );
}
