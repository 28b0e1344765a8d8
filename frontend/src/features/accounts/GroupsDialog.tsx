import { Alert, Button, Card, Group, Modal, Pill, Stack, Text, TextInput } from '@mantine/core';
import { IconUserPlus } from '@tabler/icons-react';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { fetchAgain } from '@/api/queries';
import type { Me } from '@/api/types';
import { accounts, type UserGroup } from './api';
import { CopyRow } from './CopyRow';

interface GroupsDialogProps {
  readonly me: Me;
  readonly isOpen: boolean;
  readonly onClose: () => void;
}

/** A dialogue with the user's classes, their members and their invitation links. */
export function GroupsDialog({ me, isOpen, onClose }: GroupsDialogProps) {
  const { t } = useTranslation('accounts');
  return (
    <Modal opened={isOpen} onClose={onClose} title={t('groups.title')} size="lg" centered>
      {isOpen ? <Groups me={me} /> : null}
    </Modal>
  );
}

function Groups({ me }: { readonly me: Me }) {
  const { t } = useTranslation('accounts');
  const queries = useQueryClient();
  const { data, error } = useQuery({ queryKey: ['groups'], queryFn: accounts.groups });
  const [name, setName] = useState('');
  const change = useMutation({
    mutationFn: (step: () => Promise<unknown>) => step(),
    onSettled: () => fetchAgain(queries, ['groups']),
  });
  const run = (step: () => Promise<unknown>) => change.mutate(step);
  const problem = change.error ?? error;
  const create = (event: FormEvent) => {
    event.preventDefault();
    if (!name.trim()) return;
    run(() => accounts.createGroup(name.trim()));
    setName('');
  };
  return (
    <Stack gap="md">
      {problem ? (
        <Alert color="red" role="alert">
          {problem.message}
        </Alert>
      ) : null}
      {data?.length === 0 ? <Text c="dimmed">{t('groups.none')}</Text> : null}
      {data?.map((group) => (
        <GroupCard key={group.id} group={group} me={me} run={run} />
      ))}
      {me.role === 'teacher' || me.role === 'administrator' ? (
        <form onSubmit={create}>
          <Group gap={8} align="end" wrap="nowrap">
            <TextInput
              flex={1}
              label={t('groups.new')}
              placeholder={t('groups.newHint')}
              maxLength={80}
              value={name}
              onChange={(event) => setName(event.currentTarget.value)}
            />
            <Button type="submit" disabled={!name.trim()} loading={change.isPending}>
              {t('groups.make')}
            </Button>
          </Group>
        </form>
      ) : null}
    </Stack>
  );
}

interface GroupCardProps {
  readonly group: UserGroup;
  readonly me: Me;
  readonly run: (step: () => Promise<unknown>) => void;
}

function GroupCard({ group, me, run }: GroupCardProps) {
  const { t, i18n } = useTranslation('accounts');
  const [isSure, setSure] = useState(false);
  return (
    <Card withBorder padding="md" component="section" aria-label={group.name}>
      <Group justify="space-between" wrap="nowrap" mb={6}>
        <Text fw={600} truncate="end">
          {group.name}
        </Text>
        {group.mine ? (
          <Button
            size="compact-xs"
            variant="subtle"
            color="red"
            onBlur={() => setSure(false)}
            onClick={() => (isSure ? run(() => accounts.deleteGroup(group.id)) : setSure(true))}
          >
            {t(isSure ? 'groups.reallyDelete' : 'groups.delete')}
          </Button>
        ) : (
          <Button
            size="compact-xs"
            variant="subtle"
            onClick={() => run(() => accounts.removeMember(group.id, me.user))}
          >
            {t('groups.leave')}
          </Button>
        )}
      </Group>
      {group.mine ? (
        <Stack gap={10}>
          {group.members.length > 0 ? (
            <Pill.Group>
              {group.members.map((member) => (
                <Pill
                  key={member.username}
                  withRemoveButton
                  // Mantine hides this button from the keyboard and from screen readers, since it normally is
                  // inside of a field.
                  removeButtonProps={{
                    'aria-label': t('share.remove', { who: member.username }),
                    'aria-hidden': false,
                    tabIndex: 0,
                  }}
                  onRemove={() => run(() => accounts.removeMember(group.id, member.username))}
                >
                  {member.name || member.username}
                </Pill>
              ))}
            </Pill.Group>
          ) : (
            <Text size="sm" c="dimmed">
              {t('groups.empty')}
            </Text>
          )}
          {group.invitations.map((invitation) => (
            <CopyRow
              key={invitation.id}
              url={invitation.url}
              label={t('groups.invitation')}
              note={t('groups.used', {
                uses: invitation.uses,
                max: invitation.max_uses,
                date: new Date(invitation.expires_at).toLocaleDateString(i18n.language),
              })}
              onRevoke={() => run(() => accounts.revokeInvitation(invitation.id))}
            />
          ))}
          <Button
            variant="default"
            size="xs"
            w="fit-content"
            leftSection={<IconUserPlus size={15} />}
            onClick={() => run(() => accounts.invite(group.id))}
          >
            {t('groups.invite')}
          </Button>
        </Stack>
      ) : (
        <Text size="sm" c="dimmed">
          {t('groups.by', { who: group.owner })}
        </Text>
      )}
    </Card>
  );
}
