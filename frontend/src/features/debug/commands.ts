import {
  IconArrowBarDown,
  IconArrowBarToUp,
  IconArrowRampRight2,
  IconCircleOff,
  IconPlayerPlayFilled,
  IconHandOff,
} from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { switchBreakpoints, useBreakpoints } from '@/store/debug/breakpoints';
import {
  canDebug,
  canForce,
  continueRun,
  release,
  stepInto,
  stepOut,
  stepOver,
} from '@/store/debug/debugger';
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
    labelKey: 'debug:command.over',
    icon: IconArrowRampRight2,
    shortcut: 'F10',
    run: () => void stepOver(),
  },
  {
    ...whenHeld,
    id: 'debug.into',
    labelKey: 'debug:command.into',
    icon: IconArrowBarDown,
    shortcut: 'F11',
    run: () => void stepInto(),
  },
  {
    ...whenHeld,
    id: 'debug.out',
    labelKey: 'debug:command.out',
    icon: IconArrowBarToUp,
    shortcut: 'Shift+F11',
    run: () => void stepOut(),
  },
];

const others: readonly UserCommand[] = [
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
