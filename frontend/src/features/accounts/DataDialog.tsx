import { Alert, Button, Divider, Modal, Progress, Stack, Text, TextInput } from '@mantine/core';
import { IconDownload } from '@tabler/icons-react';
import { useMutation, useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Me } from '@/api/types';
import { accounts } from './api';

interface DataDialogProps {
  readonly me: Me;
  readonly isOpen: boolean;
  readonly onClose: () => void;
}

const MIB = 1024 * 1024;

/** A dialogue with the user's disk use, the download of all data, and the deletion of the account. */
export function DataDialog({ me, isOpen, onClose }: DataDialogProps) {
  const { t } = useTranslation('accounts');
  return (
    <Modal opened={isOpen} onClose={onClose} title={t('data.title')} centered>
      {isOpen ? <MyData me={me} /> : null}
    </Modal>
  );
}

function MyData({ me }: { readonly me: Me }) {
  const { t, i18n } = useTranslation('accounts');
  const usage = useQuery({ queryKey: ['usage'], queryFn: accounts.usage }).data;
  const [typed, setTyped] = useState('');
  const end = useMutation({
    mutationFn: () => accounts.deleteMe(typed),
    onSuccess: () => window.location.assign('/accounts/login/'),
  });
  const size = (bytes: number) =>
    `${(bytes / MIB).toLocaleString(i18n.language, { maximumFractionDigits: 1 })} MiB`;
  return (
    <Stack gap="md">
      {usage ? (
        <div>
          <Text size="sm" mb={6}>
            {t('data.usage', {
              used: size(usage.bytes),
              max: size(usage.max_bytes),
              projects: usage.projects,
            })}
          </Text>
          <Progress
            value={(100 * usage.bytes) / Math.max(1, usage.max_bytes)}
            aria-label={t('data.room')}
            color={usage.bytes > 0.9 * usage.max_bytes ? 'red' : 'indigo'}
          />
          <Text size="sm" mt={6}>
            {t('data.runs', {
              used: size(usage.run_bytes),
              max: size(usage.max_run_bytes),
              runs: usage.runs,
            })}
          </Text>
        </div>
      ) : null}
      <Button
        component="a"
        href={accounts.dataUrl}
        download
        variant="default"
        leftSection={<IconDownload size={16} />}
      >
        {t('data.download')}
      </Button>
      <Divider />
      <Text size="sm">{t('data.deleteNote', { name: me.user })}</Text>
      <TextInput
        label={t('data.typeName')}
        value={typed}
        onChange={(event) => setTyped(event.currentTarget.value)}
      />
      {end.error ? (
        <Alert color="red" role="alert">
          {end.error.message}
        </Alert>
      ) : null}
      <Button color="red.9" disabled={typed !== me.user} loading={end.isPending} onClick={() => end.mutate()}>
        {t('data.delete')}
      </Button>
    </Stack>
  );
}
