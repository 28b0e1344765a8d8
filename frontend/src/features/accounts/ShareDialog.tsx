import {
  ActionIcon,
  Alert,
  Avatar,
  Button,
  Group,
  Modal,
  Select,
  Stack,
  Text,
  TextInput,
} from '@mantine/core';
import { IconLink, IconUsers, IconX } from '@tabler/icons-react';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { useState, type FormEvent, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { accounts, type SharedRole, type Shares } from './api';
import { CopyRow } from './CopyRow';

interface ShareDialogProps {
  readonly projectId: string;
  readonly name: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
}

/** With whom a project is shared: people, classes, and whoever has a link. For its owner. */
export function ShareDialog({ projectId, name, isOpen, onClose }: ShareDialogProps) {
  const { t } = useTranslation('accounts');
  return (
    <Modal opened={isOpen} onClose={onClose} title={t('share.title', { name })} size="lg" centered>
      {isOpen ? <Sharing projectId={projectId} /> : null}
    </Modal>
  );
}

function Sharing({ projectId }: { readonly projectId: string }) {
  const { t, i18n } = useTranslation('accounts');
  const queries = useQueryClient();
  const key = ['shares', projectId];
  const { data, error } = useQuery({ queryKey: key, queryFn: () => accounts.shares(projectId) });
  const groups = useQuery({ queryKey: ['groups'], queryFn: accounts.groups }).data ?? [];
  const change = useMutation({
    mutationFn: (step: () => Promise<unknown>) => step(),
    onSettled: () => queries.invalidateQueries({ queryKey: key }),
  });
  const run = (step: () => Promise<unknown>) => change.mutate(step);
  const problem = change.error ?? error;
  if (!data) return problem ? <Alert color="red">{problem.message}</Alert> : null;
  const addable = groups.filter((group) => !data.groups.some((shared) => shared.id === group.id));
  return (
    <Stack gap="md">
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
        <Shared shares={data} projectId={projectId} run={run} />
      </Stack>
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

function label(person: { username: string; name: string }): string {
  return person.name ? `${person.name} (${person.username})` : person.username;
}

interface SharedProps {
  readonly shares: Shares;
  readonly projectId: string;
  readonly run: (step: () => Promise<unknown>) => void;
}

function Shared({ shares, projectId, run }: SharedProps) {
  const { t } = useTranslation('accounts');
  return (
    <>
      {shares.people.map((person) => (
        <Row
          key={person.username}
          picture={<Avatar size="sm" name={person.username} color="initials" />}
          name={label(person)}
        >
          <RoleSelect
            value={person.role}
            who={person.username}
            onChange={(role) => run(() => accounts.shareWithPerson(projectId, person.username, role))}
          />
          <Remove
            label={t('share.remove', { who: person.username })}
            onClick={() => run(() => accounts.unshareWithPerson(projectId, person.username))}
          />
        </Row>
      ))}
      {shares.groups.map((group) => (
        <Row key={group.id} picture={<IconUsers size={22} />} name={group.name}>
          <RoleSelect
            value={group.role}
            who={group.name}
            onChange={(role) => run(() => accounts.shareWithGroup(projectId, group.id, role))}
          />
          <Remove
            label={t('share.remove', { who: group.name })}
            onClick={() => run(() => accounts.unshareWithGroup(projectId, group.id))}
          />
        </Row>
      ))}
    </>
  );
}

interface RowProps {
  readonly picture: ReactNode;
  readonly name: string;
  readonly children: ReactNode;
}

function Row({ picture, name, children }: RowProps) {
  return (
    <Group component="li" gap={10} wrap="nowrap" mih={36}>
      {picture}
      <Text flex={1} truncate="end" title={name}>
        {name}
      </Text>
      {children}
    </Group>
  );
}

interface RoleSelectProps {
  readonly value: SharedRole;
  readonly who: string;
  readonly onChange: (role: SharedRole) => void;
}

function RoleSelect({ value, who, onChange }: RoleSelectProps) {
  const { t } = useTranslation('accounts');
  return (
    <Select
      size="xs"
      w={140}
      aria-label={t('share.roleOf', { who })}
      allowDeselect={false}
      data={[
        { value: 'viewer', label: t('role.viewer') },
        { value: 'editor', label: t('role.editor') },
      ]}
      value={value}
      onChange={(role) => role && onChange(role as SharedRole)}
    />
  );
}

function Remove({ label: words, onClick }: { readonly label: string; readonly onClick: () => void }) {
  return (
    <ActionIcon aria-label={words} title={words} onClick={onClick}>
      <IconX size={16} />
    </ActionIcon>
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
