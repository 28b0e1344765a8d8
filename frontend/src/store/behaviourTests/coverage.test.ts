import { beforeEach, describe, expect, it } from 'vitest';
import type { TestReport } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { coverageOf, showCoverage, useCoverage } from './coverage';
import { useTests } from './report';

const report = {
  tests: [
    { name: 'one', file: 'tests/a.test.yaml', reached: { Main: { r: ['ticked', 'RUNNING'] } } },
    { name: 'none', file: 'tests/a.test.yaml', reached: {} },
  ],
  problems: [],
  coverage: {
    share: 0.6,
    trees: {
      Main: {
        share: 0.6,
        nodes: {
          r: { name: 'r', type: 'Sequence', items: { ticked: true, RUNNING: true } },
          a: { name: 'a', type: 'Turn', items: { ticked: true, SUCCESS: false } },
          b: { name: 'b', type: 'Turn', items: { ticked: false } },
        },
      },
      Empty: { share: 1, nodes: {} },
    },
  },
} as unknown as TestReport;

describe('coverageOf', () => {
  it('tells blocks that are never, partly and fully covered', () => {
    const { blocks, trees } = coverageOf(report, null);
    expect(Object.fromEntries(blocks)).toEqual({
      'Main/r': { level: 'fully', missing: [], items: 2 },
      'Main/a': { level: 'partly', missing: ['SUCCESS'], items: 2 },
      'Main/b': { level: 'never', missing: ['ticked'], items: 1 },
    });
    expect(trees.get('Main')).toEqual({ share: 0.6, counts: { never: 1, partly: 1, fully: 1 } });
    expect(trees.get('Empty')?.share).toBe(1);
  });

  it('is that of one test if it is chosen', () => {
    const one = coverageOf(report, 'tests/a.test.yaml: one');
    expect(one.trees.get('Main')).toEqual({ share: 0.4, counts: { never: 2, partly: 0, fully: 1 } });
    const none = coverageOf(report, 'tests/a.test.yaml: none');
    expect(none.trees.get('Main')).toEqual({ share: 0, counts: { never: 3, partly: 0, fully: 0 } });
  });
});

describe('the shown coverage', () => {
  beforeEach(() => {
    openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
    useTests.setState({
      ...useTests.getInitialState(),
      project: useProjectStore.getState().projectId,
      report,
    });
  });

  it('is there only while it is wanted', () => {
    expect(useCoverage.getState()).toMatchObject({ isShown: false, blocks: new Map() });
    showCoverage(true);
    expect(useCoverage.getState().blocks.size).toBe(3);
    showCoverage(false);
    expect(useCoverage.getState()).toMatchObject({ isShown: false, blocks: new Map() });
  });

  it('follows the reports, and returns to all tests when the chosen one is gone', () => {
    showCoverage(true, 'tests/a.test.yaml: one');
    expect(useCoverage.getState().chosen).toBe('tests/a.test.yaml: one');
    useTests.setState({ report: { ...report, tests: [] } });
    expect(useCoverage.getState().chosen).toBeNull();
    expect(useCoverage.getState().trees.get('Main')?.share).toBe(0.6);
  });

  it('ends with the project', () => {
    showCoverage(true);
    useProjectStore.getState().close();
    expect(useCoverage.getState()).toMatchObject({ isShown: false, blocks: new Map() });
  });
});
