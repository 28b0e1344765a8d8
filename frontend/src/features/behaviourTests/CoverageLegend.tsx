import { ActionIcon, Loader, NativeSelect } from '@mantine/core';
import { IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { showCoverage, testKey, useCoverage } from '@/store/behaviourTests/coverage';
import { reportOf, useTests } from '@/store/behaviourTests/report';
import { useHasTests, useTestsAfterSave } from '@/store/behaviourTests/useTestsAfterSave';
import { useProjectStore } from '@/store/project';
import { LevelSign } from './CoverageMark';
import classes from './coverage.module.css';

const LEVELS = ['never', 'partly', 'fully'] as const;

/** The legend of the coverage on the canvas, with the share of the tree and the choice of a test. */
export function CoverageLegend({ treeId }: { readonly treeId: string }) {
  const isShown = useCoverage((state) => state.isShown);
  return isShown ? <Legend treeId={treeId} /> : null;
}

function Legend({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('behaviourTests');
  useTestsAfterSave();
  const hasTests = useHasTests();
  const projectId = useProjectStore((state) => state.projectId);
  const report = useTests((state) => reportOf(state, projectId));
  const { isRunning, refused } = useTests();
  const chosen = useCoverage((state) => state.chosen);
  const covered = useCoverage((state) => state.trees.get(treeId));
  const ran = report?.tests.filter(({ outcome }) => outcome === 'passed' || outcome === 'failed') ?? [];
  return (
    <section
      className={classes['legend']}
      data-overlay=""
      aria-label={t('legend.label')}
      data-testid="coverage-legend"
    >
      <strong title={t('legend.label')}>
        {covered ? t('legend.share', { percent: Math.floor(covered.share * 100) }) : t('legend.title')}
      </strong>
      {isRunning && <Loader size={12} aria-label={t('running')} />}
      {!hasTests ? (
        <p>{t('legend.noTests')}</p>
      ) : refused !== null ? (
        <p>{t('refused', { reason: refused })}</p>
      ) : (
        <>
          <NativeSelect
            size="xs"
            className={classes['choice'] ?? ''}
            aria-label={t('legend.choose')}
            value={chosen ?? ''}
            onChange={({ currentTarget }) => showCoverage(true, currentTarget.value || null)}
            data={[
              { value: '', label: t('legend.all') },
              ...ran.map((test) => ({ value: testKey(test), label: test.name })),
            ]}
          />
          {covered ? (
            <ul>
              {LEVELS.map((level) => (
                <li key={level} data-level={level} title={t(`level.${level}`)}>
                  <LevelSign level={level} />
                  {t(`legend.${level}`, { count: covered.counts[level] })}
                </li>
              ))}
            </ul>
          ) : report ? (
            <p>{t('legend.notThis')}</p>
          ) : null}
        </>
      )}
      <ActionIcon
        size={24}
        variant="subtle"
        color="gray"
        aria-label={t('legend.close')}
        title={t('legend.close')}
        onClick={() => showCoverage(false)}
      >
        <IconX size={15} aria-hidden="true" />
      </ActionIcon>
    </section>
  );
}
