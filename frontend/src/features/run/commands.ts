import {
  IconDeviceFloppy,
  IconDeviceGamepad2,
  IconFocus2,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerSkipForwardFilled,
  IconPlayerStopFilled,
  IconPlayerTrackNextFilled,
  IconPower,
  IconRefresh,
  IconRobot,
  IconRotateClockwise,
  IconSteeringWheel,
  IconTransform,
  IconWorldBolt,
} from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import {
  canRestart,
  canResume,
  canRunWorld,
  canStep,
  canStop,
  hasSession,
  isViewer,
  isPaused,
  isRunning,
  pause,
  end,
  resetWorld,
  resume,
  runWorld,
  step,
  stepMany,
  stop,
  takeOver,
} from '@/store/run/commands';
import { toggleFollowing } from './following';
import { applyProject, restartProject, runProject } from '@/store/run/run';
import { setDriving, useTeleop } from '@/store/run/teleop';
import { openOwnRobots } from '@/store/dialogs/ownRobots';
import { openRunsDialog } from '@/store/dialogs/runs';
import { isLookingBack } from '@/store/moment/store';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';

const rows: UserCommand[] = [
  {
    id: 'run.run',
    group: 'run',
    labelKey: 'run:command.run',
    icon: IconPlayerPlayFilled,
    shortcut: 'F5',
    inTextFields: true,
    enabled: () => useRunStore.getState().stage === null && useRunStore.getState().runBlocker === null,
    run: () => void runProject(),
  },
  {
    id: 'run.pause',
    group: 'run',
    labelKey: 'run:command.pause',
    icon: IconPlayerPauseFilled,
    shortcut: 'F6',
    inTextFields: true,
    enabled: isRunning,
    run: () => void pause(),
  },
  {
    id: 'run.resume',
    group: 'run',
    labelKey: 'run:command.resume',
    icon: IconPlayerPlayFilled,
    shortcut: 'F7',
    inTextFields: true,
    enabled: canResume,
    run: () => void resume(),
  },
  {
    id: 'run.step',
    group: 'run',
    labelKey: 'run:command.step',
    icon: IconPlayerSkipForwardFilled,
    shortcut: 'F10',
    inTextFields: true,
    enabled: canStep,
    run: () => void step(),
  },
  {
    id: 'run.stop',
    group: 'run',
    labelKey: 'run:command.stop',
    icon: IconPlayerStopFilled,
    shortcut: 'Shift+F5',
    inTextFields: true,
    enabled: canStop,
    run: () => void stop(),
  },
  {
    id: 'run.step10',
    group: 'run',
    labelKey: 'run:command.step10',
    icon: IconPlayerTrackNextFilled,
    shortcut: '$mod+F10',
    inTextFields: true,
    enabled: canStep,
    run: () => void stepMany(10),
  },
  {
    id: 'run.followRunning',
    group: 'run',
    labelKey: 'run:command.followRunning',
    icon: IconFocus2,
    run: toggleFollowing,
  },
  {
    id: 'run.teleop',
    group: 'run',
    labelKey: 'run:command.teleop',
    icon: IconDeviceGamepad2,
    run: () => setDriving(!useTeleop.getState().isOn),
  },
  {
    id: 'run.restart',
    group: 'run',
    labelKey: 'run:command.restart',
    icon: IconRotateClockwise,
    shortcut: '$mod+Shift+F5',
    inTextFields: true,
    enabled: () => canRestart() && useRunStore.getState().stage === null,
    run: () => void restartProject(),
  },
  {
    id: 'run.apply',
    group: 'run',
    labelKey: 'run:command.apply',
    icon: IconTransform,
    shortcut: '$mod+Shift+Enter',
    inTextFields: true,
    enabled: () => (isRunning() || isPaused()) && useRunStore.getState().stage === null,
    run: () => void applyProject(),
  },
  {
    id: 'run.resetWorld',
    group: 'run',
    labelKey: 'run:command.resetWorld',
    icon: IconRefresh,
    enabled: () => !['idle', 'connected'].includes(useSessionStore.getState().executor),
    run: () => void resetWorld(),
  },
  {
    id: 'run.world',
    group: 'run',
    labelKey: 'run:command.world',
    icon: IconWorldBolt,
    enabled: canRunWorld,
    run: () => void runWorld(),
  },
  {
    id: 'run.takeOver',
    group: 'run',
    labelKey: 'run:command.takeOver',
    icon: IconSteeringWheel,
    enabled: isViewer,
    run: () => void takeOver(),
  },
  {
    id: 'run.kept',
    group: 'run',
    labelKey: 'run:command.kept',
    icon: IconDeviceFloppy,
    run: openRunsDialog,
  },
  {
    id: 'run.mine',
    group: 'run',
    labelKey: 'run:command.mine',
    icon: IconRobot,
    enabled: () => useRunStore.getState().runBlocker !== 'guest',
    run: openOwnRobots,
  },
  {
    id: 'run.end',
    group: 'run',
    labelKey: 'run:command.end',
    icon: IconPower,
    enabled: hasSession,
    run: () => void end(),
  },
];

/** The commands that do not act on the world, or only end what acts on it. */
const OF_THE_PAST = ['run.stop', 'run.end', 'run.followRunning', 'run.takeOver', 'run.kept', 'run.mine'];

/** Returns a command that is not available while the page shows the past, if it acts on the world. */
const inPresent = (row: UserCommand): UserCommand =>
  OF_THE_PAST.includes(row.id)
    ? row
    : { ...row, enabled: () => !isLookingBack() && row.enabled?.() !== false };

export const registerRunCommands = () => registerCommands(rows.map(inPresent));
