import { IconHistory, IconPencil, IconStar, IconTrash } from '@tabler/icons-react';
import type { UserCommand } from '@/commands/registry';
import { openRename } from '@/store/dialogs/files';
import { setScope } from '@/store/revisions/scope';
import { useProjectStore } from '@/store/project';
import { treeIdOf, treePath } from '@/store/project/state';
import { removeDocument } from './removing';
import { showPanel, useTabs } from '@/workspace/tabs';

/** Returns the path of the document in front. */
function pathInFront(): string | null {
  const { front } = useTabs.getState();
  if (front?.kind === 'tree') return treePath(front.id);
  return front?.kind === 'file' ? front.path : null;
}

const isMain = (path: string): boolean => treeIdOf(path) === useProjectStore.getState().mainTree;
const hasFile = (): boolean => ![null, 'project.json'].includes(pathInFront());
const hasSpareFile = (): boolean => hasFile() && !isMain(pathInFront() ?? '');
const hasSpareTree = (): boolean => {
  const tree = treeIdOf(pathInFront() ?? '');
  return tree !== null && tree in useProjectStore.getState().diagrams && hasSpareFile();
};
const onFile = (act: (path: string) => void) => () => {
  const path = pathInFront();
  if (path !== null) act(path);
};

/** The commands of the explorer's menu, applied to the document in front. */
export const fileCommands: readonly UserCommand[] = [
  {
    id: 'file.rename',
    group: 'project',
    labelKey: 'frame:command.renameFile',
    icon: IconPencil,
    enabled: hasFile,
    run: onFile(openRename),
  },
  {
    id: 'file.makeMain',
    group: 'project',
    labelKey: 'frame:command.makeMain',
    icon: IconStar,
    enabled: hasSpareTree,
    run: onFile((path) => useProjectStore.getState().setSettings({ main_tree: treeIdOf(path) ?? '' })),
  },
  {
    id: 'file.history',
    group: 'project',
    labelKey: 'frame:command.fileHistory',
    icon: IconHistory,
    enabled: hasFile,
    run: onFile(() => {
      setScope('file');
      showPanel('history');
    }),
  },
  {
    id: 'file.delete',
    group: 'project',
    labelKey: 'frame:command.deleteFile',
    icon: IconTrash,
    enabled: hasSpareFile,
    run: onFile((path) => void removeDocument(path)),
  },
];
