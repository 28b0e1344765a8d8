import { Loader, Select, Switch, Text, TextInput } from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { IconSearch } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { takenIn } from '@/store/project/library';
import { BehaviourRow } from './BehaviourRow';
import classes from './library.module.css';
import { useLibrary, useOtherProjects, useTreesOf } from './useReusables';

const BUILT_IN = 'library';

interface SourceProps {
  readonly value: string;
  readonly onChange: (source: string) => void;
}

/** The field that chooses the source of the behaviours; a project is found by its name. */
function Source({ value, onChange }: SourceProps) {
  const { t } = useTranslation('library');
  const projectId = useProjectStore((state) => state.projectId);
  const [chosen, setChosen] = useState({ value: BUILT_IN, label: '' });
  const [typed, setTyped] = useState('');
  const builtIn = { value: BUILT_IN, label: t('builtIn') };
  const label = chosen.value === BUILT_IN ? builtIn.label : chosen.label;
  const [search] = useDebouncedValue(typed === label ? '' : typed, 200);
  const projects = useOtherProjects(projectId, search);
  const found = (projects.data ?? []).map(({ id, name }) => ({ value: id, label: name }));
  const isAway = chosen.value !== BUILT_IN && !found.some((each) => each.value === chosen.value);
  const data = [builtIn, ...found, ...(isAway ? [chosen] : [])];
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
        setChosen(data.find((each) => each.value === next) ?? builtIn);
        onChange(next ?? BUILT_IN);
      }}
    />
  );
}

/** The panel of reusable behaviours: the built-in library, and the trees of the user's other projects. */
export function Library() {
  const { t, i18n } = useTranslation('library');
  const record = useProjectStore((state) => state.currentText('assets/library.json'));
  const [source, setSource] = useState(BUILT_IN);
  const [search, setSearch] = useState('');
  const [showsAll, setShowsAll] = useState(false);
  const library = useLibrary(i18n.language);
  const trees = useTreesOf(source === BUILT_IN ? null : source);
  const taken = useMemo(() => takenIn(record), [record]);
  const { data, error, isPending } = source === BUILT_IN ? library : trees;
  // If a project offers some of its trees, its other trees are shown only on demand.
  const curates = (data ?? []).some(({ isOffered }) => isOffered);
  const hasMore = curates && (data ?? []).some(({ isOffered }) => !isOffered);
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const offers = (data ?? []).filter((offer) => showsAll || !curates || offer.isOffered);
  const shown = offers.filter(({ id, summary, doc }) => {
    const text = `${id} ${summary} ${doc}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });

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
      {isPending ? <Loader size="xs" m="md" aria-label={t('loading')} /> : null}
      {error ? (
        <Text size="sm" p="sm" c="red">
          {error.message}
        </Text>
      ) : null}
      <ul className={classes['list']}>
        {shown.map((offer) => (
          <BehaviourRow
            key={`${offer.source}/${offer.id}`}
            offer={offer}
            takenVersion={taken[`${offer.source}/${offer.id}`]?.version ?? null}
          />
        ))}
      </ul>
      {data && shown.length === 0 ? (
        <Text size="sm" p="sm" c="dimmed">
          {t('nothing')}
        </Text>
      ) : null}
    </section>
  );
}
