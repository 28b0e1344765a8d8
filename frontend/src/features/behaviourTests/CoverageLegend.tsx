import { ActionIcon, Loader, NativeSelect } from '@mantine/core';
import { IconX } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import {
  showCoverage,
  testKey,
  useCoverage,
  type CoveredTree,
  type EvaluatedCoverage,
} from '@/store/behaviourTests/coverage';
import { reportOf, useTests } from '@/store/behaviourTests/report';
import { useHasTests, useTestsAfterSave } from '@/store/behaviourTests/useTestsAfterSave';
import { useProjectStore } from '@/store/project';
import { LevelSign } from './CoverageMark';
import classes from './coverage.module.css';

const LEVELS = ['never', 'partly', 'fully'] as const;

/** The legend of the coverage on the canvas, with the share of the tree and the choice of a test. */
export function CoverageLegend({ treeId }: { readonly treeId: string }) {
  const isShown = useCoverage((state) => state.isShown);
  const evaluated = useCoverage((state) => state.evaluated);
  if (!isShown) return null;
  return evaluated ? <EvaluatedLegend treeId={treeId} {...evaluated} /> : <Legend treeId={treeId} />;
}

/** The legend of the coverage by the runs of an evaluation. */
function EvaluatedLegend({
  treeId,
  name,
  revision,
  runs,
}: { readonly treeId: string } & Pick<EvaluatedCoverage, 'name' | 'revision' | 'runs'>) {
  const { t } = useTranslation('behaviourTests');
  const covered = useCoverage((state) => state.trees.get(treeId));
  return (
    <Frame
      label={t('legend.runsLabel')}
      title={covered ? t('legend.share', { percent: Math.floor(covered.share * 100) }) : t('legend.title')}
    >
      <p>{t('legend.runs', { name, revision, count: runs })}</p>
      {covered ? <Levels covered={covered} /> : <p>{t('legend.notRun')}</p>}
    </Frame>
  );
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
    <Frame
      label={t('legend.label')}
      title={covered ? t('legend.share', { percent: Math.floor(covered.share * 100) }) : t('legend.title')}
    >
      {isRunning && <Loader size={12} role="status" aria-label={t('running')} />}
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
          {covered ? <Levels covered={covered} /> : report ? <p>{t('legend.notThis')}</p> : null}
        </>
      )}
    </Frame>
  );
}

interface FrameProps {
  readonly label: string;
  readonly title: string;
  readonly children: ReactNode;
}

function Frame({ label, title, children }: FrameProps) {
  const { t } = useTranslation('behaviourTests');
  return (
    <section className={classes['legend']} data-overlay="" aria-label={label} data-testid="coverage-legend">
      <strong title={label}>{title}</strong>
      {children}
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

function Levels({ covered }: { readonly covered: CoveredTree }) {
  const { t } = useTranslation('behaviourTests');
  return (
    <ul>
      {LEVELS.map((level) => (
        <li key={level} data-level={level} title={t(`level.${level}`)}>
          <LevelSign level={level} />
          {t(`legend.${level}`, { count: covered.counts[level] })}
        </li>
      ))}
    </ul>
  );
}
