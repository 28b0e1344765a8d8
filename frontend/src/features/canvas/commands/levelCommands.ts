import { IconFold, IconFoldUp, IconFoldDown } from '@tabler/icons-react';
import { collapseToLevel } from '@/model/edits';
import { activeDiagram, change } from '@/store/project/edits/blocks';
import { fitSoon, isTreeShown } from '../view/views';
import type { BlockCommand } from './blockCommands';

const hasBranches = (): boolean =>
  Object.values(activeDiagram()?.nodes ?? {}).some(({ children }) => (children?.length ?? 0) > 0);
const isFolded = (): boolean =>
  Object.values(activeDiagram()?.nodes ?? {}).some(({ collapsed }) => collapsed);
const beside = (words: string, isOffered: () => boolean) => (isOnBlock: boolean) =>
  !isOnBlock && isOffered() ? words : null;

const LEVELS = [1, 2, 3, 4] as const;

/** The commands that fold the whole tree at a depth, as editors fold code. */
export const levelCommands: readonly BlockCommand[] = [
  ...LEVELS.map((level): BlockCommand => ({
    id: `canvas.collapse${level}`,
    group: 'canvas',
    labelKey: `canvas:command.collapse${level}`,
    inMenu: beside(`collapse${level}`, hasBranches),
    icon: level === 1 ? IconFoldUp : IconFold,
    enabled: () => isTreeShown() && hasBranches(),
    run: () => {
      change('collapse', [collapseToLevel(level)]);
      fitSoon();
    },
  })),
  {
    id: 'canvas.collapseAll',
    group: 'canvas',
    labelKey: 'canvas:command.collapseAll',
    inMenu: beside('collapseAll', isFolded),
    icon: IconFoldDown,
    enabled: () => isTreeShown() && isFolded(),
    run: () => {
      change('expandAll', [collapseToLevel(Infinity)]);
      fitSoon();
    },
  },
];
