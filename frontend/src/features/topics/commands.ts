import { IconPlugConnected, IconSend } from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { isLookingBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { openConnect } from './ConnectDialog';
import { openPublish } from './publishing';

const rows: UserCommand[] = [
  {
    id: 'run.connectRos',
    group: 'run',
    labelKey: 'topics:command.connect',
    icon: IconPlugConnected,
    run: openConnect,
  },
  {
    id: 'run.publish',
    group: 'run',
    labelKey: 'topics:command.publish',
    icon: IconSend,
    enabled: () => !isLookingBack() && !['idle', 'connected'].includes(useSessionStore.getState().executor),
    run: () => openPublish('', ''),
  },
];

export const registerTopicCommands = () => registerCommands(rows);
