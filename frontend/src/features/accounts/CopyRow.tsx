import { ActionIcon, CopyButton, Group, TextInput, Tooltip } from '@mantine/core';
import { IconCheck, IconCopy, IconTrash } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';

interface CopyRowProps {
  readonly url: string;
  readonly label: string;
  readonly note: string;
  readonly onRevoke: () => void;
}

/** A link that the user can copy and revoke. */
export function CopyRow({ url, label, note, onRevoke }: CopyRowProps) {
  const { t } = useTranslation('accounts');
  return (
    <Group gap={6} wrap="nowrap" align="end">
      <TextInput
        readOnly
        value={url}
        aria-label={label}
        description={note}
        flex={1}
        inputWrapperOrder={['label', 'input', 'description']}
        onFocus={(event) => event.currentTarget.select()}
      />
      <Group gap={2} wrap="nowrap" pb={20}>
        <CopyButton value={url}>
          {({ copied, copy }) => (
            <Tooltip label={t(copied ? 'copied' : 'copy')}>
              <ActionIcon size="lg" aria-label={t('copy')} onClick={copy} color={copied ? 'teal' : 'gray'}>
                {copied ? <IconCheck size={18} /> : <IconCopy size={18} />}
              </ActionIcon>
            </Tooltip>
          )}
        </CopyButton>
        <Tooltip label={t('takeBack')}>
          <ActionIcon size="lg" aria-label={t('takeBack')} onClick={onRevoke}>
            <IconTrash size={18} />
          </ActionIcon>
        </Tooltip>
      </Group>
    </Group>
  );
}
