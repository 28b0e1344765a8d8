import { create } from 'zustand';
import type { TestOutcome, TestReport } from '@/api/types';
import { liveKey, type LiveKey } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { reportOf, useTests } from './report';

/** How much of a block the tests have reached: it was never ticked, some of its items are missing, or none. */
export type Level = 'never' | 'partly' | 'fully';

export interface CoveredBlock {
  readonly level: Level;
  /** What no test has reached, as the engine names it: `FAILURE`, `branch 2 taken`, `_skipIf true`. */
  readonly missing: readonly string[];
  /** The number of items that can be reached. */
  readonly items: number;
}

export interface CoveredTree {
  readonly share: number;
  readonly counts: Readonly<Record<Level, number>>;
}

export interface ShownCoverage {
  readonly blocks: ReadonlyMap<LiveKey, CoveredBlock>;
  readonly trees: ReadonlyMap<string, CoveredTree>;
}

/** The item of a node that was ticked. */
const TICKED = 'ticked';

/** Names a test in a report: names are unique only within their file. */
export const testKey = ({ file, name }: Pick<TestOutcome, 'file' | 'name'>): string => `${file}: ${name}`;

/** Returns the coverage by all tests, or by one of them. */
export function coverageOf(
  { coverage, tests }: Pick<TestReport, 'coverage' | 'tests'>,
  chosen: string | null,
): ShownCoverage {
  const one = chosen === null ? undefined : tests.find((test) => testKey(test) === chosen);
  const blocks = new Map<LiveKey, CoveredBlock>();
  const trees = new Map<string, CoveredTree>();
  for (const [tree, { nodes }] of Object.entries(coverage.trees)) {
    const counts = { never: 0, partly: 0, fully: 0 };
    let total = 0;
    let left = 0;
    for (const [node, { items }] of Object.entries(nodes)) {
      const reached = one ? new Set(one.reached[tree]?.[node]) : null;
      const missing = Object.entries(items)
        .filter(([item, isReached]) => !(reached ? reached.has(item) : isReached))
        .map(([item]) => item);
      const level = missing.includes(TICKED) ? 'never' : missing.length > 0 ? 'partly' : 'fully';
      counts[level] += 1;
      total += Object.keys(items).length;
      left += missing.length;
      blocks.set(liveKey(tree, node), { level, missing, items: Object.keys(items).length });
    }
    trees.set(tree, { share: total > 0 ? (total - left) / total : 1, counts });
  }
  return { blocks, trees };
}

/** The blocks and results that the runs of an evaluation have reached. */
export interface EvaluatedCoverage {
  readonly name: string;
  readonly revision: number;
  readonly runs: number;
  readonly coverage: TestReport['coverage'];
}

export interface CoverageView extends ShownCoverage {
  /** Whether the canvas shows the coverage. */
  readonly isShown: boolean;
  /** The test whose coverage is shown, by its key; null: that of all tests. */
  readonly chosen: string | null;
  /** The evaluation whose runs are shown in place of the tests. */
  readonly evaluated: EvaluatedCoverage | null;
}

const NOTHING: ShownCoverage = { blocks: new Map(), trees: new Map() };

/** The coverage that the canvas shows. */
export const useCoverage = create<CoverageView>(() => ({
  isShown: false,
  chosen: null,
  evaluated: null,
  ...NOTHING,
}));

/** Shows the coverage of all tests, or of one, or none. */
export function showCoverage(isShown: boolean, chosen: string | null = null): void {
  useCoverage.setState({ isShown, chosen, evaluated: null });
  refresh();
}

/** Shows the coverage by the runs of an evaluation. */
export function showEvaluated(evaluated: EvaluatedCoverage): void {
  useCoverage.setState({ isShown: true, chosen: null, evaluated });
  refresh();
}

function refresh(): void {
  const { isShown, chosen, evaluated } = useCoverage.getState();
  if (evaluated) {
    useCoverage.setState(coverageOf({ coverage: evaluated.coverage, tests: [] }, null));
    return;
  }
  const report = reportOf(useTests.getState(), useProjectStore.getState().projectId);
  const known = report?.tests.some((test) => testKey(test) === chosen) ?? true;
  const now = known ? chosen : null;
  useCoverage.setState({ chosen: now, ...(isShown && report ? coverageOf(report, now) : NOTHING) });
}

useTests.subscribe((now, before) => {
  if (now.report !== before.report || now.project !== before.project) refresh();
});
useProjectStore.subscribe((now, before) => {
  if (now.projectId === before.projectId) return;
  useCoverage.setState({ isShown: false, chosen: null, evaluated: null, ...NOTHING });
});
