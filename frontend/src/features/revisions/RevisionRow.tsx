import { ActionIcon } from '@mantine/core';
import { IconChevronDown, IconChevronRight, IconTag } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { Revision } from '@/api/revisions';
import { timeAgo } from '@/i18n/timeAgo';
import { useProjectStore } from '@/store/project';
import classes from './revisions.module.css';
import { LabelButton } from './LabelButton';
import { sayRevision } from './words';

interface RevisionRowProps {
  readonly revision: Revision;
  /** The number of saves in the row; 1 within an expanded group. */
  readonly count: number;
  readonly isChosen: boolean;
  readonly isUnfolded?: boolean;
  readonly isInner?: boolean;
  readonly isAlone: boolean;
  readonly onChoose: () => void;
  readonly onUnfold?: () => void;
}

/** The row of a revision, or of a group of saves. */
export function RevisionRow({
  revision,
  count,
  isChosen,
  isUnfolded = false,
  isInner = false,
  isAlone,
  onChoose,
  onUnfold,
}: RevisionRowProps) {
  const { t, i18n } = useTranslation('revisions');
  const canEdit = useProjectStore((state) => state.role !== 'viewer');
  const when = new Date(revision.created_at);
  const Fold = isUnfolded ? IconChevronDown : IconChevronRight;
  return (
    <div className={classes['row']} data-chosen={isChosen || undefined} data-inner={isInner || undefined}>
      <button
        type="button"
        className={classes['choose']}
        data-testid={`revision-${revision.number}`}
        aria-current={isChosen}
        onClick={onChoose}
      >
        {revision.label ? (
          <span className={classes['label']}>
            <IconTag size={12} aria-hidden="true" />
            {revision.label}
          </span>
        ) : null}
        <span className={classes['message']}>{sayRevision(revision, t)}</span>
        <span className={classes['meta']}>
          <span>#{revision.number}</span>
          <time dateTime={revision.created_at} title={when.toLocaleString(i18n.language)}>
            {isInner ? when.toLocaleTimeString(i18n.language) : timeAgo(revision.created_at, i18n.language)}
          </time>
          {isAlone ? null : <span>{revision.author}</span>}
        </span>
      </button>
      {count > 1 && onUnfold ? (
        <button
          type="button"
          className={classes['count']}
          aria-expanded={isUnfolded}
          data-testid={`saves-${revision.number}`}
          onClick={onUnfold}
        >
          {t('saves', { count })}
          <Fold size={13} aria-hidden="true" />
        </button>
      ) : null}
      {canEdit ? <LabelButton revision={revision} /> : <ActionIcon size="sm" disabled aria-hidden="true" />}
    </div>
  );
}
