import { IconReplace, IconSearch } from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { openSearch } from './searchStore';

const rows: UserCommand[] = [
  {
    id: 'view.search',
    group: 'edit',
    labelKey: 'search:command.search',
    icon: IconSearch,
    shortcut: '$mod+Shift+KeyF',
    inTextFields: true,
    run: (page) => openSearch(page),
  },
  {
    id: 'view.replace',
    group: 'edit',
    labelKey: 'search:command.replace',
    icon: IconReplace,
    enabled: () => useProjectStore.getState().role !== 'viewer',
    run: (page) => openSearch(page, { isReplacing: true }),
  },
];

export const registerSearchCommands = () => registerCommands(rows);
