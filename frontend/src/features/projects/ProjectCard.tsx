import { ActionIcon, Anchor, Menu, Text, TextInput } from '@mantine/core';
import { IconCopy, IconDots, IconDownload, IconPencil, IconTrash } from '@tabler/icons-react';
import { useState, type KeyboardEvent, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import type { ProjectSummary } from '@/api/types';
import { navigate, projectPath } from '@/store/route';
import { timeAgo } from './timeAgo';
import classes from './projects.module.css';
import { TreePicture } from './TreePicture';

interface ProjectCardProps {
  readonly project: ProjectSummary;
  readonly onRename: (name: string) => void;
  readonly onDuplicate: () => void;
  readonly onDelete: () => void;
}

/** Ready to type another name as soon as the field is there. */
function focusAll(input: HTMLInputElement | null): void {
  input?.select();
}

export function ProjectCard({ project, onRename, onDuplicate, onDelete }: ProjectCardProps) {
  const { t, i18n } = useTranslation('projects');
  const [isRenaming, setRenaming] = useState(false);
  const [name, setName] = useState(project.name);
  const path = projectPath(project.id);

  const follow = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey || event.button !== 0) return;
    event.preventDefault();
    navigate(path);
  };
  const finish = (isKept: boolean) => {
    setRenaming(false);
    const wanted = name.trim();
    if (isKept && wanted && wanted !== project.name) onRename(wanted);
    else setName(project.name);
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key === 'Enter') finish(true);
    if (event.key === 'Escape') finish(false);
  };

  return (
    <article className={classes['card']} data-testid="project-card">
      <a href={path} onClick={follow} className={classes['cardPicture']} tabIndex={-1} aria-hidden="true">
        <TreePicture diagram={project.root_diagram} />
      </a>
      <div className={classes['cardText']}>
        <div className={classes['cardName']}>
          {isRenaming ? (
            <TextInput
              size="xs"
              value={name}
              aria-label={t('rename')}
              ref={focusAll}
              onChange={(event) => setName(event.currentTarget.value)}
              onBlur={() => finish(true)}
              onKeyDown={onKey}
            />
          ) : (
            <Anchor
              href={path}
              onClick={follow}
              c="var(--bts-text)"
              fw={600}
              truncate="end"
              title={project.name}
            >
              {project.name}
            </Anchor>
          )}
          <Text size="xs" c="dimmed">
            <time dateTime={project.updated_at}>
              {t('changed', { ago: timeAgo(project.updated_at, i18n.language) })}
            </time>
          </Text>
        </div>
        <Menu position="bottom-end">
          <Menu.Target>
            <ActionIcon aria-label={t('moreFor', { name: project.name })}>
              <IconDots size={18} />
            </ActionIcon>
          </Menu.Target>
          <Menu.Dropdown>
            <Menu.Item leftSection={<IconPencil size={16} />} onClick={() => setRenaming(true)}>
              {t('rename')}
            </Menu.Item>
            <Menu.Item leftSection={<IconCopy size={16} />} onClick={onDuplicate}>
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
            <Menu.Divider />
            <Menu.Item color="red" leftSection={<IconTrash size={16} />} onClick={onDelete}>
              {t('delete')}
            </Menu.Item>
          </Menu.Dropdown>
        </Menu>
      </div>
    </article>
  );
}
