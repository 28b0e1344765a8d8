import {
  IconArrowBarToRight,
  IconCheck,
  IconHandOff,
  IconPointFilled,
  IconSnowflake,
  IconX,
  type Icon,
} from '@tabler/icons-react';
import type { ResultName } from '@/generated/messages';
import { breakpointOf, toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import {
  canForce,
  canStepTree,
  force,
  isOwnTree,
  nodeOf,
  nodesOf,
  release,
  stepTo,
} from '@/store/debug/debugger';
import { useDebugMarks } from '@/store/debug/marks';
import { liveKey } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { isTreeInFront } from '../inFront';
import type { BlockCommand } from './blockCommands';

const tree = () => useProjectStore.getState().activeTree ?? '';
const selection = () => useProjectStore.getState().selection;
const first = () => selection()[0] ?? '';
const hasBreakpoint = (id: string) => breakpointOf(useBreakpoints.getState(), tree(), id) !== undefined;
const runningNodes = () => selection().flatMap((id) => nodesOf(useSessionStore.getState(), tree(), id));
const hasRunning = () => runningNodes().length > 0;
const isForced = () => selection().some((id) => useDebugMarks.getState().forced.has(liveKey(tree(), id)));

/** Sets a breakpoint on all selected blocks; if all have one, removes them. */
function toggleSelected(): void {
  const isAway = selection().every(hasBreakpoint);
  selection().forEach((id) => {
    if (hasBreakpoint(id) === isAway) toggleBreakpoint(tree(), id);
  });
}

/** Whether a result can be forced on the selected blocks; another program that is followed cannot be frozen. */
const canForceTo = (status: ResultName) =>
  canForce() && hasRunning() && (status !== 'RUNNING' || isOwnTree(useSessionStore.getState()));

const forcing = (status: ResultName, words: string, icon: Icon): BlockCommand => ({
  id: `debug.force${status}`,
  group: 'run',
  labelKey: `canvas:menu.${words}`,
  inMenu: () => (canForceTo(status) ? words : null),
  icon,
  enabled: () => canForceTo(status),
  run: () => void force(runningNodes(), { effect: 'result', status }),
});

/** The debugger's commands for selected blocks. */
export const debugCommands: readonly BlockCommand[] = [
  {
    id: 'debug.breakpoint',
    group: 'run',
    labelKey: 'canvas:menu.breakpointEither',
    inMenu: () => (selection().every(hasBreakpoint) ? 'breakpointAway' : 'breakpoint'),
    icon: IconPointFilled,
    shortcut: 'F9',
    enabled: () => selection().length > 0 && isTreeInFront(),
    run: toggleSelected,
  },
  {
    id: 'debug.to',
    group: 'run',
    labelKey: 'debug:command.to',
    inMenu: () => (canStepTree() && selection().length === 1 && hasRunning() ? 'stepTo' : null),
    icon: IconArrowBarToRight,
    shortcut: '$mod+F10',
    when: 'held',
    inTextFields: true,
    enabled: () => canStepTree() && hasRunning(),
    run: () => {
      const node = nodeOf(useSessionStore.getState(), tree(), first());
      if (node) void stepTo(node);
    },
  },
  forcing('SUCCESS', 'forceSuccess', IconCheck),
  forcing('FAILURE', 'forceFailure', IconX),
  forcing('RUNNING', 'freeze', IconSnowflake),
  {
    id: 'debug.release',
    group: 'run',
    labelKey: 'canvas:menu.release',
    inMenu: () => (canForce() && isForced() ? 'release' : null),
    icon: IconHandOff,
    enabled: () => canForce() && isForced(),
    run: () => void release(runningNodes().map(({ uid }) => uid)),
  },
];
