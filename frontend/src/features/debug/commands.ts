import {
  IconArrowBarDown,
  IconArrowBarToUp,
  IconArrowRampRight2,
  IconCircleOff,
  IconPlayerPlayFilled,
  IconPlayerTrackNext,
  IconPlayerTrackPrev,
  IconHandOff,
} from '@tabler/icons-react';
import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { switchBreakpoints, useBreakpoints } from '@/store/debug/breakpoints';
import {
  canDebug,
  canForce,
  canStep,
  canStepTree,
  continueRun,
  release,
  stepInto,
  stepOut,
  stepOver,
  stepTick,
} from '@/store/debug/debugger';
import { canTickBack, tickBack, whyNoTickBack } from '@/store/debug/tickBack';
import { hasApplication } from '@/store/run/commands';
import { useSessionStore } from '@/store/session/store';

const whenHeld = { group: 'run', when: 'held', inTextFields: true, enabled: canDebug } as const;

/** The commands of a held tree, in the order of their buttons. */
export const heldCommands: readonly UserCommand[] = [
  {
    ...whenHeld,
    id: 'debug.continue',
    labelKey: 'debug:command.continue',
    icon: IconPlayerPlayFilled,
    shortcut: 'F5',
    run: () => void continueRun(),
  },
  {
    ...whenHeld,
    id: 'debug.over',
    enabled: canStep,
    labelKey: 'debug:command.over',
    icon: IconArrowRampRight2,
    shortcut: 'F10',
    run: () => void stepOver(),
  },
  {
    ...whenHeld,
    id: 'debug.into',
    enabled: canStep,
    labelKey: 'debug:command.into',
    icon: IconArrowBarDown,
    shortcut: 'F11',
    run: () => void stepInto(),
  },
  {
    ...whenHeld,
    id: 'debug.out',
    enabled: canStep,
    labelKey: 'debug:command.out',
    icon: IconArrowBarToUp,
    shortcut: 'Shift+F11',
    run: () => void stepOut(),
  },
  {
    ...whenHeld,
    id: 'debug.tick',
    labelKey: 'debug:command.tick',
    icon: IconPlayerTrackNext,
    enabled: canStepTree,
    run: () => void stepTick(),
  },
];

/** Shows why a run cannot go one tick back; says nothing where no program runs. */
function explainNoTickBack(): boolean {
  const why = whyNoTickBack();
  if (why === null || !hasApplication()) return false;
  notifications.show({ id: `tick-back ${why}`, color: 'yellow', message: t(`debug:tickBack.${why}`) });
  return true;
}

const others: readonly UserCommand[] = [
  {
    id: 'debug.tickBack',
    group: 'run',
    labelKey: 'debug:command.tickBack',
    icon: IconPlayerTrackPrev,
    shortcut: '$mod+Shift+F10',
    inTextFields: true,
    enabled: canTickBack,
    explain: explainNoTickBack,
    run: () => void tickBack(),
  },
  {
    id: 'debug.switchBreakpoints',
    group: 'run',
    labelKey: 'debug:command.switchBreakpoints',
    icon: IconCircleOff,
    shortcut: '$mod+Shift+F9',
    inTextFields: true,
    enabled: () => useBreakpoints.getState().list.length > 0,
    run: switchBreakpoints,
  },
  {
    id: 'debug.releaseAll',
    group: 'run',
    labelKey: 'debug:command.releaseAll',
    icon: IconHandOff,
    enabled: () => canForce() && useSessionStore.getState().forced !== null,
    run: () => void release(),
  },
];

export const registerDebugCommands = () => registerCommands([...heldCommands, ...others]);
