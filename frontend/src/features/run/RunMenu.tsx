import { ActionIcon, Kbd, Menu, Tooltip } from '@mantine/core';
import { IconCheck, IconChevronDown } from '@tabler/icons-react';
import { useState } from 'react';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { setStatusRate, STATUS_RATES, useStatusRate } from '@/store/session/statusRate';
import { usePlainWords } from '@/ui/hooks/usePlainWords';
import { RateMenus, TimeMenu } from './RateSelects';
import { useFollowing } from './following';

const COMMANDS = [
  'run.run',
  'run.restart',
  'run.apply',
  'run.step10',
  'debug.tickBack',
  'run.resetWorld',
  'run.world',
  'run.teleop',
  'run.connectRos',
  'run.kept',
  'run.mine',
  'run.end',
];

/** The menu of rare commands, and of options for the statuses on blocks. */
export function RunMenu({ isDisabled }: { readonly isDisabled: boolean }) {
  const t = usePlainWords('run');
  const table = useCommandTable((state) => state.commands);
  const isFollowing = useFollowing((state) => state.isOn);
  const hz = useStatusRate((state) => state.hz);
  const [isOpen, setOpen] = useState(false);
  return (
    <Menu position="bottom-start" width={300} opened={isOpen} onChange={setOpen}>
      <Tooltip label={t('moreRun')} disabled={isOpen}>
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
              rightSection={keysOf(action) ? <Kbd size="xs">{keysOf(action)}</Kbd> : null}
              onClick={() => perform(id)}
            >
              {t(action.labelKey)}
            </Menu.Item>
          );
        })}
        <Menu.Divider />
        <Menu.CheckboxItem
          closeMenuOnClick
          checked={isFollowing}
          onChange={() => perform('run.followRunning')}
        >
          {t('command.followRunning')}
        </Menu.CheckboxItem>
        <RateMenus />
        <TimeMenu />
        <Menu.Label>{t('statusRate')}</Menu.Label>
        <Menu.RadioGroup value={String(hz)} onChange={(rate) => setStatusRate(Number(rate))}>
          {STATUS_RATES.map((rate) => (
            <Menu.RadioItem
              key={rate}
              closeMenuOnClick
              value={String(rate)}
              checkIcon={<IconCheck size={15} />}
            >
              {rate === 0 ? t('everyFrame') : t('hz', { hz: rate })}
            </Menu.RadioItem>
          ))}
        </Menu.RadioGroup>
      </Menu.Dropdown>
    </Menu>
  );
}
