import { ActionIcon, Kbd, Menu, Tooltip } from '@mantine/core';
import { IconCheck, IconChevronDown } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform, useActionTable } from '@/actions/registry';
import { shortcutLabel } from '@/actions/shortcuts';
import { setStatusRate, STATUS_RATES, useStatusRate } from '@/store/session/statusRate';
import { RateMenus } from './RateSelects';
import { useFollowing } from './following';
import classes from './run.module.css';

const COMMANDS = ['run.step10', 'run.restart', 'run.resetWorld', 'run.teleop', 'run.connectRos'];

/** What is not needed often enough for a button, and how the run is shown on the blocks. */
export function RunMenu({ isDisabled }: { readonly isDisabled: boolean }) {
  const { t } = useTranslation('run');
  const table = useActionTable((state) => state.actions);
  const isFollowing = useFollowing((state) => state.isOn);
  const hz = useStatusRate((state) => state.hz);
  return (
    <Menu position="bottom-start" width={300}>
      <Tooltip label={t('moreRun')}>
        <Menu.Target>
          <ActionIcon size="md" aria-label={t('moreRun')} data-testid="run-menu">
            <IconChevronDown size={15} />
          </ActionIcon>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        {COMMANDS.map((id) => {
          const action = table[id];
          if (!action) return null;
          const Icon = action.icon;
          return (
            <Menu.Item
              key={id}
              disabled={isDisabled || action.enabled?.() === false}
              leftSection={Icon ? <Icon size={15} /> : null}
              rightSection={action.shortcut ? <Kbd size="xs">{shortcutLabel(action.shortcut)}</Kbd> : null}
              onClick={() => perform(id)}
            >
              {t(action.labelKey)}
            </Menu.Item>
          );
        })}
        <Menu.Divider />
        <Menu.Item
          role="menuitemcheckbox"
          aria-checked={isFollowing}
          leftSection={<Check isOn={isFollowing} />}
          onClick={() => perform('run.followRunning')}
        >
          {t('action.followRunning')}
        </Menu.Item>
        <RateMenus />
        <Menu.Label>{t('statusRate')}</Menu.Label>
        {STATUS_RATES.map((rate) => (
          <Menu.Item
            key={rate}
            role="menuitemradio"
            aria-checked={rate === hz}
            leftSection={<Check isOn={rate === hz} />}
            onClick={() => setStatusRate(rate)}
          >
            {rate === 0 ? t('everyFrame') : t('hz', { hz: rate })}
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

function Check({ isOn }: { readonly isOn: boolean }) {
  return isOn ? <IconCheck size={15} /> : <span className={classes['unchecked']} />;
}
