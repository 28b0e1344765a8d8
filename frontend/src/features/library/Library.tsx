import { Loader, Select, Switch, Text, TextInput } from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { IconSearch } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { useFileText } from '@/store/saving/large';
import { takenIn } from '@/store/project/library';
import { BehaviourRow } from './BehaviourRow';
import classes from './library.module.css';
import { useLibrary, useOffers, useOtherProjects, useTreesOf, type Offer } from './useReusables';

/** The source that is chosen first: the built-in behaviours, and what projects offer. */
const ALL = 'all';

interface SourceProps {
  readonly value: string;
  readonly onChange: (source: string) => void;
}

/** The field that chooses the source of the behaviours; a project is found by its name. */
function Source({ value, onChange }: SourceProps) {
  const { t } = useTranslation('library');
  const projectId = useProjectStore((state) => state.projectId);
  const [chosen, setChosen] = useState({ value: ALL, label: '' });
  const [typed, setTyped] = useState('');
  const all = { value: ALL, label: t('all') };
  const label = chosen.value === ALL ? all.label : chosen.label;
  const [search] = useDebouncedValue(typed === label ? '' : typed, 200);
  const projects = useOtherProjects(projectId, search);
  const found = (projects.data ?? []).map(({ id, name }) => ({ value: id, label: name }));
  const isAway = chosen.value !== ALL && !found.some((each) => each.value === chosen.value);
  const data = [all, ...found, ...(isAway ? [chosen] : [])];
  return (
    <Select
      size="xs"
      aria-label={t('source')}
      data-testid="library-source"
      allowDeselect={false}
      searchable
      nothingFoundMessage={t('noProject')}
      value={value}
      data={data}
      onSearchChange={setTyped}
      onChange={(next) => {
        setChosen(data.find((each) => each.value === next) ?? all);
        onChange(next ?? ALL);
      }}
    />
  );
}

interface RowsProps {
  readonly title?: string;
  readonly offers: readonly Offer[];
  readonly record: string | null;
}

/** A list of behaviours; a list with a title also shows the project of each. */
function Rows({ title, offers, record }: RowsProps) {
  const taken = useMemo(() => takenIn(record), [record]);
  return (
    <>
      {title === undefined ? null : <h2 className={classes['section']}>{title}</h2>}
      <ul className={classes['list']} aria-label={title}>
        {offers.map((offer) => (
          <BehaviourRow
            key={`${offer.source}/${offer.id}`}
            offer={offer}
            namesProject={title !== undefined}
            takenVersion={taken[`${offer.source}/${offer.id}`]?.version ?? null}
          />
        ))}
      </ul>
    </>
  );
}

const holds = (texts: readonly (string | null)[], words: readonly string[]): boolean => {
  const text = texts.join(' ').toLowerCase();
  return words.every((word) => text.includes(word));
};

/** The panel of reusable behaviours: the built-in library, and the trees of the user's projects. */
export function Library() {
  const { t, i18n } = useTranslation('library');
  const record = useFileText('assets/library.json');
  const [source, setSource] = useState(ALL);
  const [search, setSearch] = useState('');
  const [showsAll, setShowsAll] = useState(false);
  const projectId = useProjectStore((state) => state.projectId);
  const library = useLibrary(i18n.language);
  const offered = useOffers(projectId);
  const trees = useTreesOf(source === ALL ? null : source);
  const isAll = source === ALL;
  const { data, error, isPending } = isAll ? library : trees;
  // Both lists appear at the same time, so that neither pushes the other down.
  const isLoading = isPending || (isAll && offered.isLoading);
  // If a project offers some of its trees, its other trees are shown only on demand.
  const curates = (data ?? []).some(({ isOffered }) => isOffered);
  const hasMore = curates && (data ?? []).some(({ isOffered }) => !isOffered);
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const shown = (data ?? [])
    .filter((offer) => showsAll || !curates || offer.isOffered)
    .filter(({ id, summary, doc }) => holds([id, summary, doc], words));
  const ofProjects = (isAll ? (offered.data ?? []) : []).filter(({ id, summary, project, owner }) =>
    holds([id, summary, project, owner], words),
  );
  const problems = [error, isAll ? offered.error : null].filter((each) => each !== null);

  return (
    <section className={classes['library']} aria-label={t('label')} data-testid="library">
      <div className={classes['head']}>
        <TextInput
          size="xs"
          leftSection={<IconSearch size={14} aria-hidden="true" />}
          placeholder={t('search')}
          aria-label={t('search')}
          value={search}
          onChange={(event) => setSearch(event.currentTarget.value)}
        />
        <Source value={source} onChange={setSource} />
        {hasMore ? (
          <Switch
            size="xs"
            label={t('allTrees')}
            checked={showsAll}
            onChange={(event) => setShowsAll(event.currentTarget.checked)}
          />
        ) : null}
      </div>
      {isLoading ? <Loader size="xs" m="md" role="status" aria-label={t('loading')} /> : null}
      {problems.map(({ message }) => (
        <Text key={message} size="sm" p="sm" c="red">
          {message}
        </Text>
      ))}
      {ofProjects.length > 0 ? <Rows title={t('ofProjects')} offers={ofProjects} record={record} /> : null}
      {ofProjects.length > 0 && shown.length > 0 ? (
        <h2 className={classes['section']}>{t('builtIn')}</h2>
      ) : null}
      {isLoading ? null : <Rows offers={shown} record={record} />}
      {data && !isLoading && shown.length + ofProjects.length === 0 ? (
        <Text size="sm" p="sm" c="dimmed">
          {t('nothing')}
        </Text>
      ) : null}
    </section>
  );
}
