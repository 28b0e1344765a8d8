import { useTranslation } from 'react-i18next';
import { displayName } from '@/model/diagram';
import { carriedBy, linesToLookAt, type KeyChange, type RenamePlan } from '@/model/keys/rename';
import { SHARED, type Forest } from '@/model/keys/scope';
import { closeRenameKey } from '@/store/dialogs/renameKey';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import classes from './keys.module.css';

interface PlanViewProps {
  readonly plan: RenamePlan;
  /** The old name of the key. */
  readonly name: string;
  readonly forest: Forest;
}

/** The list of changes that renaming a key makes, by tree, and of the places that the user must check. */
export function PlanView({ plan, name, forest }: PlanViewProps) {
  const { t } = useTranslation('keys');
  const trees = [...new Set(plan.changes.map(({ tree }) => tree))];
  const carriers = carriedBy(forest, plan);
  const boards = [...plan.scope].filter((board) => board !== SHARED);
  return (
    <div className={classes['plan']} data-testid="rename-key-plan">
      <p className={classes['scope']}>
        {t('scope', { trees: boards.join(', ') || t('shared') })}
        {plan.scope.has(SHARED) ? ` ${t('scopeShared', { name })}` : ''}
        {carriers.length > 0 ? ` ${t('carried', { trees: carriers.join(', ') })}` : ''}
      </p>
      {trees.map((tree) => (
        <section key={tree} aria-label={tree}>
          <h3 className={classes['tree']}>{tree}</h3>
          <ul className={classes['list']}>
            {plan.changes
              .filter((change) => change.tree === tree)
              .map((change) => (
                <ChangeRow key={`${change.node} ${change.part} ${change.name}`} change={change} />
              ))}
          </ul>
        </section>
      ))}
      {plan.unread.length > 0 ? (
        <section aria-label={t('unread')}>
          <h3 className={classes['tree']}>{t('unread')}</h3>
          <ul className={classes['list']}>
            {plan.unread.map(({ tree, node, text }) => (
              <li key={`${tree} ${node} ${text}`}>
                {tree}: <code>{text}</code>
              </li>
            ))}
          </ul>
        </section>
      ) : null}
      <PythonLines name={name} />
    </div>
  );
}

function ChangeRow({ change }: { readonly change: KeyChange }) {
  const { t } = useTranslation('keys');
  const { tree, node: id, part, name, before, after } = change;
  const node = useProjectStore(({ diagrams }) => diagrams[tree]?.nodes[id ?? '']);
  return (
    <li>
      <span className={classes['where']}>
        {node ? `${displayName(node)} · ` : ''}
        {t(`part.${part}`, { name })}
      </span>
      <code>
        <del>{before}</del> <ins>{after}</ins>
      </code>
    </li>
  );
}

/** The lines of Python that may mean the key; each is a link to its place. */
function PythonLines({ name }: { readonly name: string }) {
  const { t } = useTranslation('keys');
  const files = useProjectStore((state) => state.files);
  const texts = Object.fromEntries(
    Object.values(files).flatMap(({ path, text }) => (text === null ? [] : [[path, text]])),
  );
  const lines = linesToLookAt(texts, name);
  if (lines.length === 0) return null;
  return (
    <section aria-label={t('lookAt')}>
      <h3 className={classes['tree']}>{t('lookAt')}</h3>
      <ul className={classes['list']}>
        {lines.map(({ path, line, text }) => (
          <li key={`${path} ${line}`}>
            <button
              type="button"
              className={classes['line']}
              onClick={() => {
                closeRenameKey();
                openFile(path, line);
              }}
            >
              {path}:{line}
            </button>
            <code>{text}</code>
          </li>
        ))}
      </ul>
    </section>
  );
}
