import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import {
  IconDots,
  IconFileCode,
  IconFileText,
  IconGitFork,
  IconHistory,
  IconPencil,
  IconRobot,
  IconStar,
  IconTrash,
  IconWorld,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { openRename } from '@/store/dialogs/files';
import { setScope } from '@/store/revisions/scope';
import { ROBOT_FILE } from '@/store/dialogs/newRobot';
import { UNIVERSE_FILE } from '@/store/dialogs/newUniverse';
import type { Worst } from '@/store/problems/list';
import { useProjectStore } from '@/store/project';
import { treeIdOf } from '@/store/project/state';
import classes from './explorer.module.css';
import { removeDocument } from './removing';
import type { DocumentTab } from '@/workspace/documents';
import { openTab, showPanel } from '@/workspace/tabs';

interface ExplorerItemProps {
  readonly path: string;
  readonly isTree: boolean;
  readonly isAction: boolean;
  readonly worst: Worst | undefined;
}

function nameOf(path: string): string {
  const treeId = treeIdOf(path);
  return treeId ?? path.replace(/^(actions|universes)\//, '').replace(/^robots\/([^/]+)\/robot\.yaml$/, '$1');
}

export function ExplorerItem({ path, isTree, isAction, worst }: ExplorerItemProps) {
  const { t } = useTranslation('frame');
  const treeId = treeIdOf(path);
  const isDiagram = useProjectStore((state) => state.files[path]?.kind === 'tree');
  const isBinary = useProjectStore((state) => state.files[path]?.kind === 'binary');
  const isMain = useProjectStore((state) => treeId !== null && state.mainTree === treeId);
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

  const showHistory = () => {
    openTab(tab);
    setScope('file');
    showPanel('history');
  };

  return (
    <div className={classes['item']} data-severity={worst}>
      <button
        type="button"
        className={classes['open']}
        data-testid={`file-${path}`}
        disabled={isBinary}
        title={path}
        onClick={() => openTab(tab)}
      >
        <Icon size={16} stroke={1.6} aria-hidden="true" />
        <span className={classes['name']}>{nameOf(path)}</span>
        {isMain ? (
          <Tooltip label={t('explorer.mainTree')}>
            <IconStar size={13} className={classes['star']} role="img" aria-label={t('explorer.mainTree')} />
          </Tooltip>
        ) : null}
      </button>
      {path === 'project.json' ? null : (
        <Menu position="bottom-end">
          <Menu.Target>
            <ActionIcon
              size="sm"
              className={classes['more']}
              aria-label={t('explorer.moreFor', { name: nameOf(path) })}
            >
              <IconDots size={15} />
            </ActionIcon>
          </Menu.Target>
          <Menu.Dropdown>
            {isDiagram && treeId !== null && !isMain ? (
              <Menu.Item
                leftSection={<IconStar size={16} />}
                onClick={() => useProjectStore.getState().setSettings({ main_tree: treeId })}
              >
                {t('explorer.makeMain')}
              </Menu.Item>
            ) : null}
            <Menu.Item leftSection={<IconPencil size={16} />} onClick={() => openRename(path)}>
              {t('explorer.rename')}
            </Menu.Item>
            <Menu.Item disabled={isBinary} leftSection={<IconHistory size={16} />} onClick={showHistory}>
              {t('explorer.history')}
            </Menu.Item>
            <Menu.Item
              color="red"
              disabled={isMain}
              leftSection={<IconTrash size={16} />}
              onClick={() => void removeDocument(path)}
            >
              {t('explorer.delete')}
            </Menu.Item>
          </Menu.Dropdown>
        </Menu>
      )}
    </div>
  );
}
