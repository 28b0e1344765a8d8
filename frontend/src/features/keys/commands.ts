import { IconBraces } from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { openRenameKey } from '@/store/dialogs/renameKey';
import { useProjectStore } from '@/store/project';

const rows: UserCommand[] = [
  {
    id: 'edit.renameKey',
    group: 'edit',
    labelKey: 'keys:command',
    icon: IconBraces,
    enabled: () => useProjectStore.getState().role !== 'viewer',
    run: () => openRenameKey(),
  },
];

export const registerKeyCommands = () => registerCommands(rows);
