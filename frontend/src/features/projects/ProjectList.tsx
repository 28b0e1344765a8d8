import {
  Alert,
  Button,
  Center,
  Group,
  SegmentedControl,
  Select,
  Skeleton,
  Text,
  TextInput,
  Title,
} from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { IconAlertTriangle, IconPlayerPlay, IconSearch } from '@tabler/icons-react';
import { useState, type RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import type { ProjectShelf, ProjectSort } from '@/api/client';
import { useShowMore } from '@/ui/hooks/useShowMore';
import { ShowMore } from '@/ui/ShowMore';
import { ProjectCard } from './ProjectCard';
import classes from './projects.module.css';
import { useProjects, type useProjectCommands } from './useProjects';

interface ProjectListProps {
  readonly actions: ReturnType<typeof useProjectCommands>;
  readonly searchField: RefObject<HTMLInputElement | null>;
}

const SHELVES: readonly ProjectShelf[] = ['current', 'archived', 'deleted'];

/** The list of the user's projects, with search and sorting. */
export function ProjectList({ actions, searchField }: ProjectListProps) {
  const { t } = useTranslation('projects');
  const [search, setSearch] = useState('');
  const [sort, setSort] = useState<ProjectSort>('-updated_at');
  const [wanted] = useDebouncedValue(search.trim(), 200);
  const [shelf, setShelf] = useState<ProjectShelf>('current');
  const found = useProjects(wanted, sort, shelf);
  const { data, error, refetch, hasNextPage } = found;
  const { showMore, isLoadingMore } = useShowMore(found, `${shelf} ${sort} ${wanted}`);
  const projects = data?.pages.flatMap((page) => page.items) ?? [];
  const total = data?.pages[0]?.total ?? 0;
  // A cached empty list may be outdated.
  const isKnown = found.isFetchedAfterMount || found.isPlaceholderData;
  const isEmpty = isKnown && data !== undefined && projects.length === 0;

  return (
    <section aria-labelledby="projects-heading">
      <Group justify="space-between" mb="md">
        <Title order={2} size={18} id="projects-heading">
          {t('yours')}
        </Title>
        <Group gap="sm">
          <Select
            value={shelf}
            w={150}
            aria-label={t('shelf.label')}
            data-testid="shelf"
            allowDeselect={false}
            onChange={(value) => setShelf(value as ProjectShelf)}
            data={SHELVES.map((value) => ({ value, label: t(`shelf.${value}`) }))}
          />
          <TextInput
            type="search"
            ref={searchField}
            value={search}
            flex="1 1 170px"
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
      </Group>
      {error ? (
        <Alert color="red" icon={<IconAlertTriangle />} title={t('listFailed')}>
          <Text size="sm">{error.message}</Text>
          <Button mt="sm" size="xs" variant="light" color="red" onClick={() => void refetch()}>
            {t('tryAgain')}
          </Button>
        </Alert>
      ) : null}
      {!isKnown && !error && projects.length === 0 ? (
        <div className={classes['grid']} aria-hidden="true">
          {[1, 2, 3].map((key) => (
            <Skeleton key={key} height={196} radius="lg" />
          ))}
        </div>
      ) : null}
      {isEmpty && !wanted && shelf === 'current' ? (
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
      {isEmpty && !wanted && shelf !== 'current' ? <Text c="dimmed">{t(`shelf.none.${shelf}`)}</Text> : null}
      {isEmpty && wanted ? <Text c="dimmed">{t('noneFound', { search: wanted })}</Text> : null}
      <div className={classes['grid']} data-testid="projects" data-total={total}>
        {projects.map((project) => (
          <ProjectCard
            key={`${project.id}-${project.name}`}
            project={project}
            shelf={shelf}
            actions={actions}
          />
        ))}
      </div>
      {hasNextPage ? (
        <Center mt="lg">
          <ShowMore
            variant="default"
            data-testid="more-projects"
            isLoading={isLoadingMore}
            onClick={showMore}
          >
            {t('showMore', { count: total - projects.length })}
          </ShowMore>
        </Center>
      ) : null}
    </section>
  );
}
