import { Badge, SegmentedControl } from '@mantine/core';
import { IconChevronRight, IconFileCode, IconGitFork } from '@tabler/icons-react';
import { Suspense, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { nameIn, type Arrival, type Choice } from '@/model/reuse';
import { TreePicture } from '@/features/projects/TreePicture';
import { useFileText } from '@/store/saving/large';
import { isInsertedInto } from '@/store/project/bringing';
import { treeIdOf } from '@/store/project/state';
import { lazyPart } from '@/ui/parts';
import { useIsNarrow } from '@/ui/hooks/useIsNarrow';
import classes from './library.module.css';

const SourceView = lazyPart(async () => (await import('@/features/inspector/SourceView')).SourceView);
const TextDifference = lazyPart(
  async () => (await import('@/features/revisions/TextDifference')).TextDifference,
);

const CHOICES = ['keep', 'rename', 'replace'] as const satisfies readonly Choice[];

interface ArrivalRowProps {
  readonly arrival: Arrival;
  readonly source: string;
  readonly onChoose: (choice: Choice) => void;
}

/** The row of an incoming file: its kind, the planned change, and its content on demand. */
export function ArrivalRow({ arrival, source, onChoose }: ArrivalRowProps) {
  const { t } = useTranslation('library');
  const [isOpen, setOpen] = useState(false);
  const { path, place, state } = arrival;
  const name = nameIn(path);
  const Icon = treeIdOf(path) === null ? IconFileCode : IconGitFork;
  const isClash = state !== 'new' && state !== 'same';
  return (
    <li className={classes['arrival']} data-testid={`arrival-${path}`} data-state={state}>
      <div className={classes['title']}>
        <button
          type="button"
          className={classes['name']}
          aria-expanded={isOpen}
          title={path}
          onClick={() => setOpen(!isOpen)}
        >
          <IconChevronRight size={13} aria-hidden="true" />
          <Icon size={15} aria-hidden="true" />
          <span>{name}</span>
        </button>
        {isClash ? null : (
          <Badge size="sm" variant="light" {...(state === 'new' ? {} : { color: 'gray' })} tt="none">
            {t(`arrivals.state.${state}`)}
          </Badge>
        )}
        {isClash && !isInsertedInto(path) ? (
          <SegmentedControl
            size="xs"
            aria-label={t('arrivals.choose', { name })}
            value={state}
            onChange={(choice) => onChoose(choice as Choice)}
            data={CHOICES.map((choice) => ({ value: choice, label: t(`arrivals.choice.${choice}`) }))}
          />
        ) : null}
      </div>
      {isClash ? (
        <p className={classes['clash']}>
          {t(`arrivals.clash.${isInsertedInto(path) ? 'here' : state}`, { name, other: nameIn(place) })}
        </p>
      ) : null}
      {isOpen ? (
        <Suspense fallback={null}>
          <Content path={path} source={source} isClash={isClash} />
        </Suspense>
      ) : null}
    </li>
  );
}

interface ContentProps {
  readonly path: string;
  readonly source: string;
  readonly isClash: boolean;
}

/**
 * The content of an incoming file: both files side by side if another file has its name, otherwise the tree's
 * picture or the action's code.
 */
function Content({ path, source, isClash }: ContentProps) {
  const { t } = useTranslation('library');
  const mine = useFileText(path);
  const isNarrow = useIsNarrow();
  if (isClash && mine !== null) {
    const labels = { before: t('arrivals.mine', { path }), after: t('arrivals.theirs', { path }) };
    return (
      <>
        <p className={classes['clash']}>{t(isNarrow ? 'arrivals.sidesUnified' : 'arrivals.sides')}</p>
        <div className={classes['difference']}>
          <TextDifference path={path} before={mine} after={source} labels={labels} />
        </div>
      </>
    );
  }
  if (treeIdOf(path) === null) {
    return (
      <div className={classes['source']}>
        <SourceView path={path} text={source} />
      </div>
    );
  }
  return (
    <div className={classes['picture']}>
      <TreePicture diagram={source} />
    </div>
  );
}
