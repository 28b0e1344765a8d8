import { IconRobot, IconWorld } from '@tabler/icons-react';
import type { UserCommand } from '@/commands/registry';
import { openRobotChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { findInUse, type Kind } from './inUse';
import { makeOwnCopy } from './ownCopy';

const canChange = (): boolean => useProjectStore.getState().role !== 'viewer';

/** Opens the editor of the universe or robot that the project uses; a built-in one is copied first. */
async function edit(kind: Kind): Promise<void> {
  const used = await findInUse(kind).catch(() => null);
  if (used?.path) openFile(used.path);
  else await makeOwnCopy(kind);
}

/** The commands for the universe and the robot that the project uses; choosing others has its own command. */
export const usedCommands: readonly UserCommand[] = [
  {
    id: 'project.chooseRobot',
    group: 'project',
    labelKey: 'frame:command.chooseRobot',
    icon: IconRobot,
    run: openRobotChooser,
  },
  {
    id: 'project.editUniverse',
    group: 'project',
    labelKey: 'frame:command.editUniverse',
    icon: IconWorld,
    enabled: canChange,
    run: () => void edit('universe'),
  },
  {
    id: 'project.editRobot',
    group: 'project',
    labelKey: 'frame:command.editRobot',
    icon: IconRobot,
    enabled: canChange,
    run: () => void edit('robot'),
  },
];
