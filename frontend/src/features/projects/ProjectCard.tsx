import { Anchor, Button, Text, TextInput } from '@mantine/core';
import { useState, type FocusEvent, type KeyboardEvent, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { ProjectShelf } from '@/api/client';
import type { ProjectSummary } from '@/api/types';
import { projectNameProblem } from '@/features/settings/names';
import { navigate, projectPath } from '@/store/route';
import { ProjectMenu } from './ProjectMenu';
import classes from './projects.module.css';
import { reasonOf } from '@/api/reason';
import { timeAgo } from '@/i18n/timeAgo';
import { TreePicture } from './TreePicture';
import type { useProjectCommands } from './useProjects';

interface ProjectCardProps {
  readonly project: ProjectSummary;
  readonly shelf: ProjectShelf;
  readonly actions: ReturnType<typeof useProjectCommands>;
}

/** Selects the text of a field, so that typing replaces the name. */
function focusAll(input: HTMLInputElement | null): void {
  input?.select();
}

/** A card for a project with its picture; the only command for a deleted project is to restore it. */
export function ProjectCard({ project, shelf, actions }: ProjectCardProps) {
  const { t, i18n } = useTranslation('projects');
  const [isRenaming, setRenaming] = useState(false);
  const [name, setName] = useState(project.name);
  const [refusal, setRefusal] = useState<string | null>(null);
  const path = projectPath(project.id);
  const isDeleted = shelf === 'deleted';

  const follow = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey || event.button !== 0) return;
    event.preventDefault();
    if (!isDeleted) navigate(path);
  };
  const finish = (isKept: boolean) => {
    const wanted = name.trim();
    const problem = wanted ? projectNameProblem(wanted) : null;
    setRefusal(isKept && problem ? t(`settings:problem.${problem}`) : null);
    if (isKept && problem) return;
    if (isKept && wanted && wanted !== project.name) {
      // A refused name stays in its field, and the reason is shown.
      const onError = (error: Error) => setRefusal(reasonOf(error));
      actions.rename.mutate({ project, name: wanted }, { onError });
      return;
    }
    setRenaming(false);
    setName(project.name);
  };
  const onBlur = (event: FocusEvent<HTMLInputElement>) => {
    const input = event.currentTarget;
    // When the menu that started the renaming closes, it returns the focus to its button; the field takes the
    // focus back.
    if (input.closest('article')?.contains(event.relatedTarget)) setTimeout(() => input.focus());
    else finish(true);
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key === 'Enter') finish(true);
    if (event.key === 'Escape') finish(false);
  };

  return (
    <article className={classes['card']} data-testid="project-card">
      <a href={path} onClick={follow} className={classes['cardPicture']} tabIndex={-1} aria-hidden="true">
        <TreePicture diagram={project.root_diagram} conditions={project.conditions} />
      </a>
      <div className={classes['cardText']}>
        <div className={classes['cardName']}>
          {isRenaming ? (
            <TextInput
              size="xs"
              value={name}
              aria-label={t('rename')}
              error={refusal}
              disabled={actions.rename.isPending}
              ref={focusAll}
              onChange={(event) => setName(event.currentTarget.value)}
              onBlur={onBlur}
              onKeyDown={onKey}
            />
          ) : isDeleted ? (
            <Text className={classes['projectName']} fw={600} truncate="end" title={project.name}>
              {project.name}
            </Text>
          ) : (
            <Anchor
              className={classes['projectName']}
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
        {isDeleted ? (
          <Button
            size="compact-sm"
            variant="light"
            loading={actions.restore.isPending}
            onClick={() => actions.restore.mutate(project)}
          >
            {t('restore')}
          </Button>
        ) : (
          <ProjectMenu project={project} shelf={shelf} actions={actions} onRename={() => setRenaming(true)} />
        )}
      </div>
    </article>
  );
}
