import { ActionIcon, Button, Loader, ScrollArea, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import {
  IconCircleCheck,
  IconCircleDashed,
  IconCircleX,
  IconPercentage60,
  IconPlayerPlay,
  IconPlayerStop,
} from '@tabler/icons-react';
import { useMutation } from '@tanstack/react-query';
import { useLayoutEffect, useRef, type RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import type { TestFailure, TestOutcome, TestReport } from '@/api/types';
import { showCoverage, testKey, useCoverage } from '@/store/behaviourTests/coverage';
import { revealFailure } from '@/store/behaviourTests/failures';
import { endTests, NEEDS_PYTHON, reportOf, runTests, useTests } from '@/store/behaviourTests/report';
import { useHasTests, useTestsAfterSave } from '@/store/behaviourTests/useTestsAfterSave';
import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import { FIRST_TEST, firstTest } from './firstTest';
import classes from './tests.module.css';

const ICONS = {
  passed: IconCircleCheck,
  failed: IconCircleX,
  needs_python: IconCircleDashed,
  not_run: IconCircleDashed,
};

/** The project's behaviour tests with their results; they run again after each save. */
export function TestsPanel() {
  const hasTests = useHasTests();
  return (
    <div className={classes['panel']} data-testid="tests">
      {hasTests ? <Tests /> : <NoTests />}
    </div>
  );
}

function NoTests() {
  const { t } = useTranslation('behaviourTests');
  const write = () => {
    const { mainTree, diagrams, actions, addFile } = useProjectStore.getState();
    addFile(FIRST_TEST, firstTest(mainTree, diagrams[mainTree], new Set(actions.map(({ name }) => name))));
    openFile(FIRST_TEST);
  };
  return (
    <div className={classes['none']}>
      <Text size="sm">{t('none')}</Text>
      <Button size="xs" variant="light" onClick={write}>
        {t('write')}
      </Button>
      <Text size="xs" c="dimmed">
        {t('learn')}
      </Text>
    </div>
  );
}

function Tests() {
  const { t } = useTranslation('behaviourTests');
  const projectId = useProjectStore((state) => state.projectId);
  const { isRunning, isEnded, turn, refused } = useTests();
  const canEnd = useTests(({ withPython }) => projectId !== null && withPython.includes(projectId));
  const shown = useTests((state) => reportOf(state, projectId));
  const runButton = useRef<HTMLButtonElement>(null);
  useTestsAfterSave();
  return (
    <>
      <div className={classes['bar']}>
        <Button
          ref={runButton}
          size="compact-sm"
          variant="light"
          leftSection={<IconPlayerPlay size={14} aria-hidden="true" />}
          onClick={() => void runTests()}
        >
          {t('run')}
        </Button>
        {shown?.tests.some(({ outcome }) => outcome === NEEDS_PYTHON) ? (
          <Button
            size="compact-sm"
            variant="subtle"
            disabled={isRunning}
            title={t('withPythonHint')}
            onClick={() => void runTests({ withPython: true })}
          >
            {t('withPython')}
          </Button>
        ) : null}
        {canEnd ? <EndButton next={runButton} /> : null}
        <div role="status" className={classes['summary']}>
          {isRunning ? <Loader size={14} role="status" aria-label={t('running')} /> : null}
          {turn ? (
            <span>{turn.isOwn ? t('turn.own') : t('turn.waiting', { count: turn.before })}</span>
          ) : refused !== null ? (
            <span className={classes['bad']}>{t('refused', { reason: refused })}</span>
          ) : isEnded ? (
            <span>{t('end.done')}</span>
          ) : shown ? (
            <Summary report={shown} />
          ) : null}
        </div>
        {shown ? <TreeShares report={shown} /> : null}
      </div>
      <ScrollArea className={classes['rest'] ?? ''} type="auto">
        <ul className={classes['list']} aria-label={t('label')}>
          {shown?.problems.map((problem, index) => (
            <li key={`problem-${index}`}>
              <button
                type="button"
                className={classes['row']}
                data-outcome="failed"
                onClick={() => openFile(problem.file ?? '', problem.line ?? undefined)}
              >
                <IconCircleX size={16} aria-label={t('outcome.failed')} role="img" />
                <span>
                  {problem.message} <span className={classes['muted']}>{problem.hint}</span>
                </span>
                <span className={classes['muted']}>{`${problem.file}:${problem.line}`}</span>
              </button>
            </li>
          ))}
          {shown?.tests.map((test) => (
            <Row key={`${test.file}:${test.name}`} test={test} />
          ))}
        </ul>
      </ScrollArea>
    </>
  );
}

/**
 * Ends the user's tests with Python, which run or wait for a place.
 *
 * @param next Gets the focus if this button has it when it goes.
 */
function EndButton({ next }: { readonly next: RefObject<HTMLButtonElement | null> }) {
  const { t } = useTranslation('behaviourTests');
  const { mutate, isPending } = useMutation({
    mutationFn: endTests,
    onError: (error) =>
      notifications.show({ color: 'red', title: t('end.failed'), message: reasonOf(error) }),
  });
  const button = useRef<HTMLButtonElement>(null);
  useLayoutEffect(() => {
    const [shown, after] = [button.current, next.current];
    return () => {
      if (shown !== null && shown === document.activeElement) after?.focus();
    };
  }, [next]);
  return (
    <Button
      ref={button}
      size="compact-sm"
      variant="default"
      aria-busy={isPending} // not disabled, which would take the focus
      title={t('end.help')}
      leftSection={
        isPending ? <Loader size={14} aria-hidden="true" /> : <IconPlayerStop size={14} aria-hidden="true" />
      }
      onClick={() => (isPending ? undefined : mutate())}
      data-testid="end-tests"
    >
      {t('end.do')}
    </Button>
  );
}

function Summary({ report }: { readonly report: TestReport }) {
  const { t } = useTranslation('behaviourTests');
  const passed = report.tests.filter(({ outcome }) => outcome === 'passed').length;
  const failed = report.tests.filter(({ outcome }) => outcome === 'failed').length + report.problems.length;
  return (
    <>
      <span data-testid="tests-summary" className={failed > 0 ? classes['bad'] : undefined}>
        {t('summary', { passed, failed })}
      </span>
      <span className={classes['muted']}>
        {t('covered', { percent: Math.floor(report.coverage.share * 100) })}
      </span>
    </>
  );
}

/** The share of each tree; a press shows the tree with its coverage. */
function TreeShares({ report }: { readonly report: TestReport }) {
  const { t } = useTranslation('behaviourTests');
  return (
    <ul className={classes['shares']} aria-label={t('trees')}>
      {Object.entries(report.coverage.trees).map(([tree, { share }]) => (
        <li key={tree}>
          <button type="button" className={classes['share']} onClick={() => showOn(tree, null)}>
            {t('treeShare', { tree, percent: Math.floor(share * 100) })}
          </button>
        </li>
      ))}
    </ul>
  );
}

function showOn(tree: string, chosen: string | null): void {
  openTree(tree || useProjectStore.getState().mainTree);
  showCoverage(true, chosen);
}

function Row({ test }: { readonly test: TestOutcome }) {
  const { t } = useTranslation('behaviourTests');
  const Icon = ICONS[test.outcome];
  const isCovering = useCoverage(({ isShown, chosen }) => isShown && chosen === testKey(test));
  const ran = test.outcome === 'passed' || test.outcome === 'failed';
  return (
    <li className={classes['test']}>
      <button
        type="button"
        className={classes['row']}
        data-outcome={test.outcome}
        onClick={() => openFile(test.file, test.line)}
      >
        <Icon size={16} role="img" aria-label={t(`outcome.${test.outcome}`)} />
        <span>{test.name}</span>
        <span className={classes['muted']}>
          {ran ? `${test.file}:${test.line}` : t(`outcome.${test.outcome}`)}
        </span>
      </button>
      {ran && (
        <ActionIcon
          className={classes['covers'] ?? ''}
          size={24}
          variant={isCovering ? 'light' : 'subtle'}
          color="gray"
          aria-pressed={isCovering}
          aria-label={t('showOf', { name: test.name })}
          title={t('showOf', { name: test.name })}
          onClick={() => (isCovering ? showCoverage(false) : showOn(test.tree, testKey(test)))}
        >
          <IconPercentage60 size={15} aria-hidden="true" />
        </ActionIcon>
      )}
      {test.failures.map((failure, index) => (
        <Failure key={index} failure={failure} file={test.file} />
      ))}
    </li>
  );
}

/** Why a test failed. It leads to the block, or to the line of the expectation where it is about no block. */
function Failure({ failure, file }: { readonly failure: TestFailure; readonly file: string }) {
  const { t } = useTranslation('behaviourTests');
  const open = () => {
    if (failure.node_id === '') return openFile(file, failure.line);
    revealFailure(failure);
  };
  return (
    <button type="button" className={classes['failure']} onClick={open}>
      <span>
        {failure.tick > 0 ? `${t('tick', { tick: failure.tick, time: failure.time_s })}: ` : ''}
        {failure.message}
      </span>
      {failure.path.length > 0 ? (
        <span className={classes['path']}>
          {failure.path.map(({ name, status }) => `${name} ${status}`).join(' › ')}
        </span>
      ) : null}
    </button>
  );
}
