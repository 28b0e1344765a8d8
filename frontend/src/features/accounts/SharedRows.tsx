import { ActionIcon, Avatar, Group, Select, Text } from '@mantine/core';
import { IconCrown, IconUsers, IconX } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { accounts, type SharedRole, type Shares } from './api';

export function label(person: { username: string; name: string }): string {
  return person.name ? `${person.name} (${person.username})` : person.username;
}

interface SharedRowsProps {
  readonly shares: Shares;
  readonly projectId: string;
  readonly run: (step: () => Promise<unknown>) => void;
  readonly onMakeOwner: (username: string) => void;
}

/** The people and groups that a project is shared with. */
export function SharedRows({ shares, projectId, run, onMakeOwner }: SharedRowsProps) {
  const { t } = useTranslation('accounts');
  return (
    <>
      {shares.people.map((person) => (
        <Row
          key={person.username}
          picture={<Avatar size="sm" name={person.username} color="initials" />}
          name={label(person)}
        >
          {person.role === 'editor' ? (
            <RowButton
              icon={<IconCrown size={16} />}
              label={t('share.makeOwner', { who: person.username })}
              onClick={() => onMakeOwner(person.username)}
            />
          ) : null}
          <RoleSelect
            value={person.role}
            who={person.username}
            onChange={(role) => run(() => accounts.shareWithPerson(projectId, person.username, role))}
          />
          <RowButton
            icon={<IconX size={16} />}
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
          <RowButton
            icon={<IconX size={16} />}
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

/** A row of a list: a picture, a name, and buttons. */
export function Row({ picture, name, children }: RowProps) {
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

interface RowButtonProps {
  readonly icon: ReactNode;
  readonly label: string;
  readonly onClick: () => void;
}

function RowButton({ icon, label: words, onClick }: RowButtonProps) {
  return (
    <ActionIcon aria-label={words} title={words} onClick={onClick}>
      {icon}
    </ActionIcon>
  );
}
