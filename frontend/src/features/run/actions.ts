import {
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerSkipForwardFilled,
  IconPlayerStopFilled,
  IconPower,
  IconRefresh,
  IconRotateClockwise,
} from '@tabler/icons-react';
import { registerActions, type UserAction } from '@/actions/registry';
import {
  hasApplication,
  hasSession,
  isPaused,
  isRunning,
  pause,
  end,
  resetWorld,
  restartApplication,
  resume,
  step,
  stop,
} from '@/store/run/commands';
import { runProject } from '@/store/run/run';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';

const rows: UserAction[] = [
  {
    id: 'run.run',
    group: 'run',
    labelKey: 'run:action.run',
    icon: IconPlayerPlayFilled,
    shortcut: 'F5',
    inTextFields: true,
    enabled: () => useRunStore.getState().stage === null,
    run: () => void runProject(),
  },
  {
    id: 'run.pause',
    group: 'run',
    labelKey: 'run:action.pause',
    icon: IconPlayerPauseFilled,
    shortcut: 'F6',
    inTextFields: true,
    enabled: isRunning,
    run: () => void pause(),
  },
  {
    id: 'run.resume',
    group: 'run',
    labelKey: 'run:action.resume',
    icon: IconPlayerPlayFilled,
    shortcut: 'F7',
    inTextFields: true,
    enabled: isPaused,
    run: () => void resume(),
  },
  {
    id: 'run.step',
    group: 'run',
    labelKey: 'run:action.step',
    icon: IconPlayerSkipForwardFilled,
    shortcut: 'F10',
    inTextFields: true,
    enabled: hasApplication,
    run: () => void step(),
  },
  {
    id: 'run.stop',
    group: 'run',
    labelKey: 'run:action.stop',
    icon: IconPlayerStopFilled,
    shortcut: 'Shift+F5',
    inTextFields: true,
    enabled: hasApplication,
    run: () => void stop(),
  },
  {
    id: 'run.restart',
    group: 'run',
    labelKey: 'run:action.restart',
    icon: IconRotateClockwise,
    enabled: hasApplication,
    run: () => void restartApplication(),
  },
  {
    id: 'run.resetWorld',
    group: 'run',
    labelKey: 'run:action.resetWorld',
    icon: IconRefresh,
    enabled: () => !['idle', 'connected'].includes(useSessionStore.getState().executor),
    run: () => void resetWorld(),
  },
  {
    id: 'run.end',
    group: 'run',
    labelKey: 'run:action.end',
    icon: IconPower,
    enabled: hasSession,
    run: () => void end(),
  },
];

export const registerRunActions = () => registerActions(rows);
