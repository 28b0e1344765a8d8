import { Alert, Avatar, Button, Group, Modal, Select, Stack, Text, TextInput } from '@mantine/core';
import { IconLink, IconUsers } from '@tabler/icons-react';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { fetchAgain } from '@/api/queries';
import { useProjectStore } from '@/store/project';
import { accounts, type SharedRole } from './api';
import { CopyRow } from './CopyRow';
import { MakeOwner } from './MakeOwner';
import { label, Row, SharedRows } from './SharedRows';
import { SharedRightsNotice } from './SharedRightsNotice';

interface ShareDialogProps {
  readonly projectId: string;
  readonly name: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
}

/** A dialogue for the owner of a project, with the people, classes and links that it is shared with. */
export function ShareDialog({ projectId, name, isOpen, onClose }: ShareDialogProps) {
  const { t } = useTranslation('accounts');
  return (
    <Modal opened={isOpen} onClose={onClose} title={t('share.title', { name })} size="lg" centered>
      {isOpen ? <Sharing projectId={projectId} onClose={onClose} /> : null}
    </Modal>
  );
}

function Sharing({ projectId, onClose }: Pick<ShareDialogProps, 'projectId' | 'onClose'>) {
  const { t, i18n } = useTranslation('accounts');
  const queries = useQueryClient();
  const key = ['shares', projectId];
  const { data, error } = useQuery({ queryKey: key, queryFn: () => accounts.shares(projectId) });
  const groups = useQuery({ queryKey: ['groups'], queryFn: accounts.groups }).data ?? [];
  const change = useMutation({
    mutationFn: (step: () => Promise<unknown>) => step(),
    onSettled: () => fetchAgain(queries, key),
  });
  const run = (step: () => Promise<unknown>) => change.mutate(step);
  const [nextOwner, setNextOwner] = useState<string | null>(null);
  const transfer = useMutation({
    mutationFn: (username: string) => accounts.makeOwner(projectId, username),
    onSuccess: () => {
      onClose();
      useProjectStore.setState({ role: 'editor' });
      return fetchAgain(queries, ['projects']);
    },
  });
  const problem = transfer.error ?? change.error ?? error;
  if (!data) return problem ? <Alert color="red">{problem.message}</Alert> : null;
  const addable = groups.filter((group) => !data.groups.some((shared) => shared.id === group.id));
  return (
    <Stack gap="md">
      <SharedRightsNotice />
      <AddPerson
        isBusy={change.isPending}
        onAdd={(who, role) => run(() => accounts.shareWithPerson(projectId, who, role))}
      />
      {problem ? (
        <Alert color="red" role="alert">
          {problem.message}
        </Alert>
      ) : null}
      <Stack gap={6} component="ul" m={0} p={0} aria-label={t('share.who')}>
        <Row
          picture={<Avatar size="sm" name={data.owner.username} color="initials" />}
          name={label(data.owner)}
        >
          <Text size="sm" c="dimmed" pr="sm">
            {t('role.owner')}
          </Text>
        </Row>
        <SharedRows shares={data} projectId={projectId} run={run} onMakeOwner={setNextOwner} />
      </Stack>
      {nextOwner === null ? null : (
        <MakeOwner
          who={nextOwner}
          isBusy={transfer.isPending}
          onConfirm={() => transfer.mutate(nextOwner)}
          onCancel={() => setNextOwner(null)}
        />
      )}
      {addable.length > 0 ? (
        <Select
          placeholder={t('share.addGroup')}
          aria-label={t('share.addGroup')}
          leftSection={<IconUsers size={16} />}
          data={addable.map((group) => ({ value: group.id, label: group.name }))}
          value={null}
          onChange={(id) => id && run(() => accounts.shareWithGroup(projectId, id, 'viewer'))}
        />
      ) : null}
      <Stack gap={6}>
        <Text fw={600}>{t('share.links')}</Text>
        {data.links.map((link) => (
          <CopyRow
            key={link.id}
            url={link.url}
            label={t('share.link')}
            note={t('share.madeOn', { date: new Date(link.created_at).toLocaleDateString(i18n.language) })}
            onRevoke={() => run(() => accounts.revokeLink(projectId, link.id))}
          />
        ))}
        <Button
          variant="default"
          w="fit-content"
          leftSection={<IconLink size={16} />}
          onClick={() => run(() => accounts.makeLink(projectId))}
        >
          {t('share.makeLink')}
        </Button>
        <Text size="xs" c="dimmed">
          {t('share.linkNote')}
        </Text>
      </Stack>
    </Stack>
  );
}

interface AddPersonProps {
  readonly isBusy: boolean;
  readonly onAdd: (who: string, role: SharedRole) => void;
}

function AddPerson({ isBusy, onAdd }: AddPersonProps) {
  const { t } = useTranslation('accounts');
  const [who, setWho] = useState('');
  const [role, setRole] = useState<SharedRole>('viewer');
  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (!who.trim()) return;
    onAdd(who.trim(), role);
    setWho('');
  };
  return (
    <form onSubmit={submit}>
      <Group gap={8} align="end" wrap="nowrap">
        <TextInput
          flex={1}
          data-autofocus
          label={t('share.add')}
          placeholder={t('share.addHint')}
          value={who}
          onChange={(event) => setWho(event.currentTarget.value)}
        />
        <Select
          w={140}
          aria-label={t('share.role')}
          allowDeselect={false}
          data={[
            { value: 'viewer', label: t('role.viewer') },
            { value: 'editor', label: t('role.editor') },
          ]}
          value={role}
          onChange={(value) => value && setRole(value as SharedRole)}
        />
        <Button type="submit" loading={isBusy} disabled={!who.trim()}>
          {t('share.addButton')}
        </Button>
      </Group>
    </form>
  );
}
