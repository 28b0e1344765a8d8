import { useTranslation } from 'react-i18next';
import { ChangeList } from '@/features/revisions/ChangeList';
import classes from './recorded.module.css';
import type { ChangedSince } from './useSince';

/** The list of what changed since the tree ran. */
export function Since({ since }: { readonly since: ChangedSince }) {
  const { t } = useTranslation('axis');
  const { difference, name, isRenamed, isAttached } = since;
  const count = difference.changes.size;
  return (
    <aside className={classes['since']} aria-label={t('past.since')} data-testid="past-since">
      <p role="status">
        {name === null ? t('past.gone') : count === 0 ? t('past.same') : t('past.changed', { count })}
        {isRenamed ? ` ${t('past.renamed', { name })}` : null}
        {isAttached ? null : ` ${t('past.roughly')}`}
      </p>
      {name === null ? null : <ChangeList difference={difference} />}
    </aside>
  );
}
