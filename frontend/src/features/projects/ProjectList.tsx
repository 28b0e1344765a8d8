import { Alert, Button, Group, SegmentedControl, Skeleton, Text, TextInput, Title } from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { IconAlertTriangle, IconPlayerPlay, IconSearch } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { ProjectSort } from '@/api/client';
import { ProjectCard } from './ProjectCard';
import classes from './projects.module.css';
import { useProjects, type useProjectActions } from './useProjects';

interface ProjectListProps {
  readonly actions: ReturnType<typeof useProjectActions>;
}

/** The user's projects, with search and order. */
export function ProjectList({ actions }: ProjectListProps) {
  const { t } = useTranslation('projects');
  const [search, setSearch] = useState('');
  const [sort, setSort] = useState<ProjectSort>('-updated_at');
  const [wanted] = useDebouncedValue(search.trim(), 200);
  const { data, error, isPending, refetch } = useProjects(wanted, sort);
  const hasNone = data?.length === 0 && wanted === '';

  return (
    <section aria-labelledby="projects-heading">
      <Group justify="space-between" mb="md">
        <Title order={2} size={18} id="projects-heading">
          {t('yours')}
        </Title>
        {hasNone ? null : (
          <Group gap="sm">
            <TextInput
              type="search"
              value={search}
              placeholder={t('search')}
              aria-label={t('search')}
              leftSection={<IconSearch size={16} />}
              onChange={(event) => setSearch(event.currentTarget.value)}
            />
            <SegmentedControl
              value={sort}
              aria-label={t('sort')}
              onChange={(value) => setSort(value as ProjectSort)}
              data={[
                { value: '-updated_at', label: t('sortChanged') },
                { value: 'name', label: t('sortName') },
              ]}
            />
          </Group>
        )}
      </Group>
      {error ? (
        <Alert color="red" icon={<IconAlertTriangle />} title={t('listFailed')}>
          <Text size="sm">{error.message}</Text>
          <Button mt="sm" size="xs" variant="light" color="red" onClick={() => void refetch()}>
            {t('tryAgain')}
          </Button>
        </Alert>
      ) : null}
      {isPending && !error ? (
        <div className={classes['grid']} aria-hidden="true">
          {[1, 2, 3].map((key) => (
            <Skeleton key={key} height={206} radius="lg" />
          ))}
        </div>
      ) : null}
      {hasNone ? (
        <div className={classes['emptyState']}>
          <Text fw={600}>{t('empty.title')}</Text>
          <Text c="dimmed" size="sm">
            {t('empty.text')}
          </Text>
          <Button
            mt="sm"
            leftSection={<IconPlayerPlay size={16} />}
            loading={actions.create.isPending}
            onClick={() => actions.create.mutate('laser_bump_and_go')}
          >
            {t('empty.button')}
          </Button>
        </div>
      ) : null}
      {data?.length === 0 && wanted ? <Text c="dimmed">{t('noneFound', { search: wanted })}</Text> : null}
      <div className={classes['grid']}>
        {data?.map((project) => (
          <ProjectCard
            key={`${project.id}-${project.name}`}
            project={project}
            onRename={(name) => actions.rename.mutate({ project, name })}
            onDuplicate={() => actions.duplicate.mutate(project)}
            onDelete={() => actions.remove.mutate(project)}
          />
        ))}
      </div>
    </section>
  );
}
