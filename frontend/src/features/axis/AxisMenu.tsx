import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import { IconAdjustmentsHorizontal } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { canChangeBranch } from '@/store/dialogs/branches';
import { canCompare } from '@/store/moment/compare/comparing';
import { canFlag } from '@/store/moment/flags';
import { canGoBack, canRunOn } from '@/store/moment/rerun/goBack';
import { useRange } from '@/store/moment/range';
import { useMoment } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';

/** The commands for marks, range, changes and zoom, in groups. */
export const AXIS_MENU = [
  ['time.goBack', 'time.runOn', 'time.tryMany', 'time.source', 'time.branch', 'time.compare'],
  ['time.flag', 'time.marks', 'time.markBack', 'time.markForth'],
  ['time.markA', 'time.markB', 'time.loop', 'time.clearRange'],
  ['time.whatChanged'],
  ['time.zoomIn', 'time.zoomOut', 'time.fit'],
] as const;

/** The menu of the time axis. */
export function AxisMenu() {
  const { t: words } = useTranslation('axis');
  return (
    <Menu position="top-end" width={300}>
      <Menu.Target>
        <Tooltip label={words('menu')}>
          <ActionIcon aria-label={words('menu')} data-testid="axis-menu">
            <IconAdjustmentsHorizontal size={16} />
          </ActionIcon>
        </Tooltip>
      </Menu.Target>
      <Menu.Dropdown>
        <Items />
      </Menu.Dropdown>
    </Menu>
  );
}

/** The commands, as far as they can be used now: they are made while the menu is open. */
function Items() {
  const { t } = useTranslation();
  const commands = useCommandTable((state) => state.commands);
  // What the commands ask for.
  useRange();
  useMoment((state) => state.t);
  useSessionStore(canFlag);
  useSessionStore(canGoBack);
  useSessionStore(canRunOn);
  useSessionStore(canChangeBranch);
  useSessionStore(canCompare);
  return AXIS_MENU.map((ids, at) => [
    at > 0 ? <Menu.Divider key={`before ${ids[0]}`} /> : null,
    ...ids.map((id) => {
      const command = commands[id];
      if (!command) return null;
      const Icon = command.icon;
      return (
        <Menu.Item
          key={id}
          data-testid={`axis-${id}`}
          disabled={command.enabled?.() === false}
          leftSection={Icon ? <Icon size={16} /> : null}
          rightSection={<kbd>{keysOf(command)}</kbd>}
          onClick={() => command.run()}
        >
          {t(command.labelKey)}
        </Menu.Item>
      );
    }),
  ]);
}
