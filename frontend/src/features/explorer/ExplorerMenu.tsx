import { ActionIcon, Menu } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import {
  IconBooks,
  IconClipboard,
  IconCopy,
  IconCopyPlus,
  IconDots,
  IconFolderOpen,
  IconHistory,
  IconPencil,
  IconStar,
  IconTrash,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { setOffered } from '@/model/edits';
import { isOffered } from '@/model/treeAttributes';
import { openRename } from '@/store/dialogs/files';
import { useProjectStore } from '@/store/project';
import { canDuplicate, duplicateDocument } from '@/store/project/duplicating';
import { withTexts } from '@/store/saving/large';
import { copyTree } from '@/store/project/edits/clipboard';
import { treeIdOf } from '@/store/project/state';
import { setScope } from '@/store/revisions/scope';
import { copyText } from '@/ui/copying';
import { PointTarget } from '@/ui/PointTarget';
import { undoNotification } from '@/ui/undoNotification';
import { showPanel } from '@/workspace/tabs';
import classes from './explorer.module.css';
import { removeDocument } from './removing';

interface ExplorerMenuProps {
  readonly path: string;
  readonly name: string;
  readonly isOpened: boolean;
  /** The point of the right click; null places the menu at its button. */
  readonly point: { readonly x: number; readonly y: number } | null;
  readonly onChange: (isOpened: boolean) => void;
  readonly onOpen: () => void;
}

/** The menu of a file. Its button, a right click, Shift+F10 and the menu key open it. */
export function ExplorerMenu({ path, name, isOpened, point, onChange, onOpen }: ExplorerMenuProps) {
  const { t } = useTranslation('frame');
  const treeId = treeIdOf(path);
  const isDiagram = useProjectStore((state) => state.files[path]?.kind === 'tree');
  const isBinary = useProjectStore((state) => state.files[path]?.kind === 'binary');
  const isMain = useProjectStore((state) => treeId !== null && state.mainTree === treeId);
  const isInLibrary = useProjectStore(({ diagrams }) => {
    const diagram = treeId === null ? undefined : diagrams[treeId];
    return diagram !== undefined && isOffered(diagram);
  });

  const showHistory = () => {
    onOpen();
    setScope('file');
    showPanel('history');
  };
  const duplicate = async () => {
    try {
      await withTexts([path]);
    } catch (error) {
      notifications.show({ color: 'red', message: reasonOf(error) });
      return;
    }
    const copy = duplicateDocument(path);
    if (copy === null) return;
    undoNotification({
      message: t('explorer.duplicated', { name: copy, from: name }),
      undoLabel: t('undo'),
      undo: () => useProjectStore.getState().deleteFile(copy),
    });
  };
  const copy = async (tree: string) => {
    await copyTree(tree);
    notifications.show({ message: t('explorer.treeCopied', { name }) });
  };
  const offer = (tree: string) => {
    const { apply, role } = useProjectStore.getState();
    apply(tree, 'offer', [setOffered(!isInLibrary)]);
    if (role === 'viewer') return;
    notifications.show({ message: t(isInLibrary ? 'explorer.offeredNot' : 'explorer.offered', { name }) });
  };
  const copyPath = () =>
    copyText(path, { done: t('explorer.copied', { path }), failed: t('explorer.notCopied', { path }) });

  const label = t('explorer.moreFor', { name });
  const button = (
    <ActionIcon size="sm" className={classes['more']} aria-label={label}>
      <IconDots size={15} />
    </ActionIcon>
  );

  return (
    <Menu
      position={point ? 'bottom-start' : 'bottom-end'}
      opened={isOpened}
      onChange={onChange}
      // A menu that fades out would jump from the point to its button meanwhile.
      transitionProps={{ duration: 0 }}
    >
      {point ? (
        <>
          <PointTarget {...point} label={label} onClose={() => onChange(false)} />
          {button}
        </>
      ) : (
        <Menu.Target>{button}</Menu.Target>
      )}
      <Menu.Dropdown>
        <Menu.Item disabled={isBinary} leftSection={<IconFolderOpen size={16} />} onClick={onOpen}>
          {t('explorer.open')}
        </Menu.Item>
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
        <Menu.Item
          disabled={!canDuplicate(path)}
          leftSection={<IconCopy size={16} />}
          onClick={() => void duplicate()}
        >
          {t('explorer.duplicate')}
        </Menu.Item>
        {isDiagram && treeId !== null ? (
          <>
            <Menu.Item leftSection={<IconCopyPlus size={16} />} onClick={() => void copy(treeId)}>
              {t('explorer.copyTree')}
            </Menu.Item>
            <Menu.Item leftSection={<IconBooks size={16} />} onClick={() => offer(treeId)}>
              {t(isInLibrary ? 'explorer.offerNot' : 'explorer.offer')}
            </Menu.Item>
          </>
        ) : null}
        <Menu.Item leftSection={<IconClipboard size={16} />} onClick={() => void copyPath()}>
          {t('explorer.copyPath')}
        </Menu.Item>
        <Menu.Item disabled={isBinary} leftSection={<IconHistory size={16} />} onClick={showHistory}>
          {t('explorer.history')}
        </Menu.Item>
        <Menu.Item
          color="var(--bts-failure)"
          disabled={isMain}
          leftSection={<IconTrash size={16} />}
          onClick={() => void removeDocument(path)}
        >
          {t('explorer.delete')}
        </Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
