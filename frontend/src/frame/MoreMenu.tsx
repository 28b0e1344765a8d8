import { ActionIcon, Kbd, Menu, Tooltip } from '@mantine/core';
import { IconMenu2 } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { useIsBasic } from '@/store/viewMode';
import { currentLanguage, LANGUAGES, setLanguage, type Language } from '@/i18n';

const ROWS = [
  'frame.palette',
  null,
  'project.newAction',
  'project.newTree',
  'project.newUniverse',
  'project.newRobot',
  'project.worlds',
  'project.settings',
  'project.takeAway',
  null,
  'run.resetWorld',
  'view.search',
  'view.history',
  'view.xml',
  'view.present',
  'view.shortcuts',
  'view.guide',
  'view.mode',
  'view.resetLayout',
] as const;

/** The commands that have a button in the full page. */
const BASIC_ROWS = ['view.theme'] as const;

export function MoreMenu() {
  const { t } = useTranslation('frame');
  const table = useCommandTable((state) => state.commands);
  const isBasic = useIsBasic();
  return (
    <Menu position="bottom-end" width={260}>
      <Tooltip label={t('more')}>
        <Menu.Target>
          <ActionIcon size="lg" aria-label={t('more')}>
            <IconMenu2 size={20} />
          </ActionIcon>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        {[...(isBasic ? BASIC_ROWS : []), ...ROWS].map((id, index) => {
          const action = id ? table[id] : undefined;
          if (!action) return <Menu.Divider key={`divider-${index}`} />;
          const Icon = action.icon;
          return (
            <Menu.Item
              key={action.id}
              disabled={action.enabled?.() === false}
              leftSection={Icon ? <Icon size={16} /> : null}
              rightSection={keysOf(action) ? <Kbd size="xs">{keysOf(action)}</Kbd> : null}
              onClick={() => perform(action.id)}
            >
              {t(action.labelKey)}
            </Menu.Item>
          );
        })}
        <Menu.Divider />
        <Menu.Label>{t('language')}</Menu.Label>
        {Object.entries(LANGUAGES).map(([code, name]) => (
          <Menu.Item
            key={code}
            lang={code}
            fw={code === currentLanguage() ? 600 : 400}
            onClick={() => setLanguage(code as Language)}
          >
            {name}
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}
