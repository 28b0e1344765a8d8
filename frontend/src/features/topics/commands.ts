import { IconPlugConnected, IconSend } from '@tabler/icons-react';
import { registerActions, type UserAction } from '@/commands/registry';
import { useSessionStore } from '@/store/session/store';
import { openConnect } from './ConnectDialog';
import { openPublish } from './publishing';

const rows: UserAction[] = [
  {
    id: 'run.connectRos',
    group: 'run',
    labelKey: 'topics:action.connect',
    icon: IconPlugConnected,
    run: openConnect,
  },
  {
    id: 'run.publish',
    group: 'run',
    labelKey: 'topics:action.publish',
    icon: IconSend,
    enabled: () => !['idle', 'connected'].includes(useSessionStore.getState().executor),
    run: () => openPublish('', ''),
  },
];

export const registerTopicActions = () => registerActions(rows);
