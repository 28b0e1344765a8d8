import { useTranslation } from 'react-i18next';
import { displayName, preorder, type NodeId } from '@/model/diagram';
import type { ChangeKind, NodeDifference, TreeDifference } from '@/model/difference/changes';
import classes from './revisions.module.css';

/** A sign for each kind of change, since colour alone is not accessible. */
export const SIGNS: Record<ChangeKind, string> = { added: '+', removed: '−', changed: '≠', moved: '⇄' };
export const COLORS: Record<ChangeKind, string> = {
  added: 'var(--bts-success)',
  removed: 'var(--bts-failure)',
  changed: 'var(--bts-running)',
  moved: 'var(--bts-accent)',
};

interface Props {
  readonly difference: TreeDifference;
  /** Called with the block whose change the pointer is at; null: with none. */
  readonly onPoint?: (id: NodeId | null) => void;
}

/** The changed blocks between two states of a tree as words. */
export function ChangeList({ difference, onPoint }: Props) {
  const { t } = useTranslation('revisions');
  return (
    <ul className={classes['changes']} aria-label={t('changes')}>
      {preorder(difference.merged).map((id) => {
        const change = difference.changes.get(id);
        const node = difference.merged.nodes[id];
        if (!change || !node) return null;
        return (
          <li
            key={id}
            data-kind={change.kind}
            onPointerEnter={() => onPoint?.(id)}
            onPointerLeave={() => onPoint?.(null)}
          >
            <Change name={displayName(node)} change={change} />
          </li>
        );
      })}
    </ul>
  );
}

function Change({ name, change }: { readonly name: string; readonly change: NodeDifference }) {
  const { t } = useTranslation('revisions');
  const isField = change.kind === 'changed';
  return (
    <>
      <span className={classes['sign']} style={{ color: COLORS[change.kind] }} aria-hidden="true">
        {SIGNS[change.kind]}
      </span>
      <div>
        <b>{name}</b>{' '}
        <span className={classes['kind']}>
          {t(`kind.${isField ? 'changed' : (change.deed ?? change.kind)}`)}
        </span>
        {change.fields.map(({ field, before, after }) => (
          <div key={field} className={classes['field']}>
            <span>{field}</span> {before === null ? null : <del>{before}</del>}
            {before !== null && after !== null ? ' → ' : null}
            {after === null ? null : <ins>{after}</ins>}
          </div>
        ))}
        {isField && change.deed !== null ? (
          <div className={classes['field']}>{t(`kind.${change.deed}`)}</div>
        ) : null}
      </div>
    </>
  );
}
