import { Avatar, Button, Menu, Text, UnstyledButton, VisuallyHidden } from '@mantine/core';
import { IconChartPie, IconLogout, IconSettings, IconShield, IconUsers } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { DataDialog } from './DataDialog';
import { GroupsDialog } from './GroupsDialog';
import { useMe } from './useMe';

type Opened = 'groups' | 'data';

/** Returns the menu's commands for the command palette. */
function rowsFor(isAdministrator: boolean, open: (dialog: Opened) => void): UserCommand[] {
  const row = (id: string, icon: typeof IconUsers, run: () => void): UserCommand => {
    return { id: `account.${id}`, group: 'go', labelKey: `accounts:${id}`, icon, run };
  };
  const goTo = (address: string) => () => {
    window.location.assign(address);
  };
  return [
    row('groups.title', IconUsers, () => open('groups')),
    row('data.title', IconChartPie, () => open('data')),
    row('account', IconSettings, goTo('/accounts/password/change/')),
    ...(isAdministrator ? [row('administration', IconShield, goTo('/admin/'))] : []),
    row('signOut', IconLogout, goTo('/accounts/logout/')),
  ];
}

/** The menu of the signed-in user; hidden on localhost, where there are no accounts. */
export function UserMenu() {
  const { t } = useTranslation('accounts');
  const me = useMe();
  const [open, setOpen] = useState<Opened | null>(null);
  const hasAccount = me !== undefined && me.mode !== 'local' && me.role !== 'guest';
  const isAdministrator = hasAccount && me.role === 'administrator';
  useEffect(
    () => (hasAccount ? registerCommands(rowsFor(isAdministrator, setOpen)) : undefined),
    [hasAccount, isAdministrator],
  );
  if (!me || me.mode === 'local') return null;
  if (me.role === 'guest') {
    const back = encodeURIComponent(window.location.pathname + window.location.search);
    return (
      <Button component="a" href={`/accounts/login/?next=${back}`} variant="default" size="xs">
        {t('signIn')}
      </Button>
    );
  }
  const close = () => setOpen(null);
  return (
    <>
      <Menu position="bottom-end" width={240}>
        <Menu.Target>
          <UnstyledButton ml={4} style={{ borderRadius: '50%' }}>
            <Avatar size={32} name={me.name || me.user} color="indigo" />
            <VisuallyHidden>{t('menu', { name: me.user })}</VisuallyHidden>
          </UnstyledButton>
        </Menu.Target>
        <Menu.Dropdown>
          <Menu.Label>
            <Text size="sm" fw={600} c="var(--bts-text)" truncate="end">
              {me.name || me.user}
            </Text>
            <Text size="xs" truncate="end">
              {me.email || t(`role.${me.role}`)}
            </Text>
          </Menu.Label>
          <Menu.Divider />
          <Menu.Item leftSection={<IconUsers size={16} />} onClick={() => setOpen('groups')}>
            {t('groups.title')}
          </Menu.Item>
          <Menu.Item leftSection={<IconChartPie size={16} />} onClick={() => setOpen('data')}>
            {t('data.title')}
          </Menu.Item>
          <Menu.Item leftSection={<IconSettings size={16} />} component="a" href="/accounts/password/change/">
            {t('account')}
          </Menu.Item>
          {me.role === 'administrator' ? (
            <Menu.Item leftSection={<IconShield size={16} />} component="a" href="/admin/">
              {t('administration')}
            </Menu.Item>
          ) : null}
          <Menu.Divider />
          <Menu.Item leftSection={<IconLogout size={16} />} component="a" href="/accounts/logout/">
            {t('signOut')}
          </Menu.Item>
        </Menu.Dropdown>
      </Menu>
      <GroupsDialog me={me} isOpen={open === 'groups'} onClose={close} />
      <DataDialog me={me} isOpen={open === 'data'} onClose={close} />
    </>
  );
}
