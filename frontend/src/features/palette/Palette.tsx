import { ActionIcon, Button, TextInput, Tooltip } from '@mantine/core';
import { IconPlus, IconSearch } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { shippedChoice } from '@/i18n/shipped';
import { allChoices, isNamed, type Choice } from '@/model/choices';
import { isOtherVariant, variantOf } from '@/model/variants';
import { useProjectStore } from '@/store/project';
import { useOfferedStore } from '@/store/project/offered';
import { useIsBasic } from '@/store/viewMode';
import { NewAction } from './NewAction';
import { PaletteGroup } from './PaletteGroup';
import { ReadyBehaviours } from './ReadyBehaviours';
import classes from './Palette.module.css';

const GROUPS = ['action', 'condition', 'control', 'decorator', 'subtree', 'builtin', 'ros', 'nav2'] as const;
type Group = (typeof GROUPS)[number];

/** The nodes with children that a first tree needs. */
const BASIC: ReadonlySet<string> = new Set([
  'Sequence',
  'Fallback',
  'ReactiveSequence',
  'ReactiveFallback',
  'Inverter',
  'RetryUntilSuccessful',
]);

/** Returns the group of a block in a first project: what the project has itself, and the basic nodes. */
function basicGroupOf({ spec }: Choice): 'own' | 'control' | null {
  if (BASIC.has(spec.type)) return 'control';
  return spec.source === 'action' || spec.family === 'subtree' ? 'own' : null;
}

function groupOf({ spec }: Choice): Group {
  if (spec.source === 'offered') return 'nav2';
  if (spec.group === 'ros') return 'ros';
  const isLeaf = spec.family === 'action' || spec.family === 'condition';
  return isLeaf && spec.source === 'builtin' ? 'builtin' : spec.family;
}

/** Returns whether the list shows a block; one variant stands for the others, which a search finds. */
const stands = ({ kind }: Choice): boolean => !isOtherVariant(kind.type);

/** Returns a block under the name of all its variants. */
function named(choice: Choice): Choice {
  const name = variantOf(choice.kind.type);
  return name === null ? choice : { ...choice, label: name };
}

/** The list of all available blocks by family; the user's own come first. */
export function Palette() {
  const { t } = useTranslation('palette');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  // The blocks that may be added depend on the tree's id, not on its content.
  const tree = useProjectStore((state) => state.diagrams[state.activeTree ?? '']?.id ?? null);
  const offered = useOfferedStore((state) => state.specs);
  const [search, setSearch] = useState('');
  const [isNaming, setIsNaming] = useState(false);
  const isBasic = useIsBasic();
  const [showsMore, setShowsMore] = useState(false);
  const isFound = (choice: Choice): boolean =>
    isNamed(choice, search.trim()) ||
    (search.length > 2 && shippedChoice(choice).toLowerCase().includes(search.toLowerCase()));
  const choices = useMemo(
    () => allChoices(tree === null ? null : { id: tree }, vocabulary, offered),
    [tree, vocabulary, offered],
  );
  const shown = search.trim() === '' ? choices.filter(stands).map(named) : choices.filter(isFound);
  // A search looks through all blocks.
  const isShort = isBasic && !showsMore && search === '';
  return (
    <section className={classes['palette']} aria-label={t('label')} data-testid="palette">
      <div className={classes['head']}>
        <TextInput
          size="xs"
          className={classes['search'] ?? ''}
          leftSection={<IconSearch size={14} aria-hidden="true" />}
          placeholder={t('search')}
          aria-label={t('search')}
          value={search}
          onChange={(event) => {
            setSearch(event.currentTarget.value);
          }}
        />
        <Tooltip label={t('newAction')}>
          <ActionIcon
            aria-label={t('newAction')}
            data-testid="new-action"
            size={30}
            onClick={() => {
              setIsNaming(true);
            }}
          >
            <IconPlus size={17} aria-hidden="true" />
          </ActionIcon>
        </Tooltip>
      </div>
      {isNaming && (
        <NewAction
          onDone={() => {
            setIsNaming(false);
          }}
        />
      )}
      <div className={classes['groups']}>
        {isShort ? (
          <>
            <PaletteGroup
              title={t('own')}
              choices={shown.filter((choice) => basicGroupOf(choice) === 'own')}
              isSearching={false}
              empty={t('noActions')}
            />
            <ReadyBehaviours search="" />
            <PaletteGroup
              title={t('families.control')}
              choices={shown.filter((choice) => basicGroupOf(choice) === 'control')}
              isSearching={false}
            />
            <Button variant="subtle" size="compact-sm" m={8} onClick={() => setShowsMore(true)}>
              {t('more')}
            </Button>
          </>
        ) : (
          GROUPS.map((group) => (
            <PaletteGroup
              key={group}
              title={t(`families.${group}`)}
              choices={shown.filter((choice) => groupOf(choice) === group)}
              isSearching={search !== ''}
              startsFolded={group === 'nav2'}
              {...(group === 'action' ? { empty: t('noActions') } : {})}
            />
          ))
        )}
        {isBasic && !isShort ? <ReadyBehaviours search={search} /> : null}
        {shown.length === 0 && <p className={classes['nothing']}>{t('nothing')}</p>}
      </div>
      <p className={classes['hint']}>{t('hint')}</p>
    </section>
  );
}
