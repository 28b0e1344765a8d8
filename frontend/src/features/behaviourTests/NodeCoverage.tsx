import { useTranslation } from 'react-i18next';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { useFailuresOf } from '@/store/behaviourTests/failures';
import { liveKey } from '@/store/project/live';
import { openFile } from '@/store/project/navigation';
import { LevelSign } from './CoverageMark';
import { itemText } from './itemText';
import classes from './coverage.module.css';

interface NodeCoverageProps {
  readonly tree: string;
  readonly node: string;
}

/** The results of tests for a block: its failures and, while the coverage is shown, its items that no test reaches. */
export function NodeCoverage({ tree, node }: NodeCoverageProps) {
  const { t } = useTranslation('behaviourTests');
  const key = liveKey(tree, node);
  const covered = useCoverage((state) => state.blocks.get(key));
  const failures = useFailuresOf(key);
  if (!covered && failures.length === 0) return null;
  return (
    <section className={classes['node']} aria-label={t('node.title')} data-testid="node-coverage">
      <h2>{t('node.title')}</h2>
      {failures.map(({ failure, test, file }, index) => (
        <button
          key={index}
          type="button"
          className={classes['nodeFailure']}
          onClick={() => openFile(file, failure.line)}
        >
          <strong>{test}</strong>
          <span>{`${t('tick', { tick: failure.tick, time: failure.time_s })}: ${failure.message}`}</span>
          <span className={classes['place']}>{`${file}:${failure.line}`}</span>
        </button>
      ))}
      {covered && (
        <>
          <p className={classes['level']}>
            <LevelSign level={covered.level} />
            {t('node.share', {
              level: t(`level.${covered.level}`),
              reached: covered.items - covered.missing.length,
              items: covered.items,
            })}
          </p>
          {covered.missing.length > 0 && (
            <ul aria-label={t('node.missing')}>
              {covered.missing.map((item) => (
                <li key={item}>{itemText(t, item)}</li>
              ))}
            </ul>
          )}
        </>
      )}
    </section>
  );
}
