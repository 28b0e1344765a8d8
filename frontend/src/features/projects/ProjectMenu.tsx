import { ActionIcon, Menu } from '@mantine/core';
import {
  IconArchive,
  IconArchiveOff,
  IconCopy,
  IconDots,
  IconDownload,
  IconPencil,
  IconTrash,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { api, type ProjectShelf } from '@/api/client';
import type { ProjectSummary } from '@/api/types';
import type { useProjectCommands } from './useProjects';

interface ProjectMenuProps {
  readonly project: ProjectSummary;
  readonly shelf: ProjectShelf;
  readonly actions: ReturnType<typeof useProjectCommands>;
  readonly onRename: () => void;
}

/** The menu of commands for a project that do not open it. */
export function ProjectMenu({ project, shelf, actions, onRename }: ProjectMenuProps) {
  const { t } = useTranslation('projects');
  const isArchived = shelf === 'archived';
  return (
    <Menu position="bottom-end">
      <Menu.Target>
        <ActionIcon aria-label={t('moreFor', { name: project.name })}>
          <IconDots size={18} />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown>
        <Menu.Item leftSection={<IconPencil size={16} />} onClick={onRename}>
          {t('rename')}
        </Menu.Item>
        <Menu.Item leftSection={<IconCopy size={16} />} onClick={() => actions.duplicate.mutate(project)}>
          {t('duplicate')}
        </Menu.Item>
        <Menu.Item
          leftSection={<IconDownload size={16} />}
          component="a"
          href={api.exportUrl(project.id)}
          download
        >
          {t('download')}
        </Menu.Item>
        <Menu.Item
          leftSection={isArchived ? <IconArchiveOff size={16} /> : <IconArchive size={16} />}
          onClick={() => (isArchived ? actions.unarchive : actions.archive).mutate(project)}
        >
          {t(isArchived ? 'unarchive' : 'archive')}
        </Menu.Item>
        <Menu.Divider />
        <Menu.Item
          color="red"
          leftSection={<IconTrash size={16} />}
          onClick={() => actions.remove.mutate(project)}
        >
          {t('delete')}
        </Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
