import { Tooltip } from '@mantine/core';
import {
  IconCloudOff,
  IconFileCode,
  IconFileText,
  IconGitFork,
  IconRobot,
  IconStar,
  IconWorld,
} from '@tabler/icons-react';
import { useState, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { shippedDoc } from '@/i18n/shipped';
import { ROBOT_FILE } from '@/store/dialogs/newRobot';
import { UNIVERSE_FILE } from '@/store/dialogs/newUniverse';
import type { Worst } from '@/store/problems/list';
import { useProjectStore } from '@/store/project';
import { treeIdOf } from '@/store/project/state';
import { useLargeFiles } from '@/store/saving/large';
import { ExplorerMenu } from './ExplorerMenu';
import classes from './explorer.module.css';
import type { DocumentTab } from '@/workspace/documents';
import { openTab } from '@/workspace/tabs';

interface ExplorerItemProps {
  readonly path: string;
  readonly isTree: boolean;
  readonly isAction: boolean;
  readonly worst: Worst | undefined;
}

/** The right button of the mouse. The keys that open a menu report another button. */
const RIGHT = 2;

function nameOf(path: string): string {
  const treeId = treeIdOf(path);
  return treeId ?? path.replace(/^(actions|universes)\//, '').replace(/^robots\/([^/]+)\/robot\.yaml$/, '$1');
}

export function ExplorerItem({ path, isTree, isAction, worst }: ExplorerItemProps) {
  const { t } = useTranslation('frame');
  const [isMenuOpen, setMenuOpen] = useState(false);
  const [point, setPoint] = useState<{ x: number; y: number } | null>(null);
  const treeId = treeIdOf(path);
  const isDiagram = useProjectStore((state) => state.files[path]?.kind === 'tree');
  const isBinary = useProjectStore((state) => state.files[path]?.kind === 'binary');
  const isOffline = useLargeFiles((state) => state.failed[path]?.isOffline === true);
  const isMain = useProjectStore((state) => treeId !== null && state.mainTree === treeId);
  const description = useProjectStore(
    ({ vocabulary }) => vocabulary.trees.get(treeId ?? '')?.description ?? '',
  );
  const tab: DocumentTab =
    isDiagram && treeId !== null ? { kind: 'tree', id: treeId } : { kind: 'file', path };
  const Icon = isTree
    ? IconGitFork
    : isAction
      ? IconFileCode
      : UNIVERSE_FILE.test(path)
        ? IconWorld
        : ROBOT_FILE.test(path)
          ? IconRobot
          : IconFileText;

  // Shift+F10 and the menu key cause the same event.
  const onContextMenu = (event: MouseEvent) => {
    if (path === 'project.json') return;
    event.preventDefault();
    setPoint(event.button === RIGHT ? { x: event.clientX, y: event.clientY } : null);
    setMenuOpen(true);
  };

  return (
    <div className={classes['item']} data-severity={worst}>
      <button
        type="button"
        className={classes['open']}
        data-testid={`file-${path}`}
        data-offline={isOffline || undefined}
        disabled={isBinary}
        title={description === '' ? path : `${path}\n${shippedDoc(treeId ?? '', description)}`}
        onContextMenu={onContextMenu}
        onClick={() => openTab(tab)}
      >
        <Icon size={16} stroke={1.6} aria-hidden="true" />
        <span className={classes['name']}>{nameOf(path)}</span>
        {isOffline ? (
          <Tooltip label={t('explorer.notLoaded')}>
            <IconCloudOff size={13} role="img" aria-label={t('explorer.notLoaded')} />
          </Tooltip>
        ) : null}
        {isMain ? (
          <Tooltip label={t('explorer.mainTree')}>
            <IconStar size={13} className={classes['star']} role="img" aria-label={t('explorer.mainTree')} />
          </Tooltip>
        ) : null}
      </button>
      {path === 'project.json' ? null : (
        <ExplorerMenu
          path={path}
          name={nameOf(path)}
          isOpened={isMenuOpen}
          point={isMenuOpen ? point : null}
          onChange={(isOpened) => {
            setPoint(null);
            setMenuOpen(isOpened);
          }}
          onOpen={() => openTab(tab)}
        />
      )}
    </div>
  );
}
