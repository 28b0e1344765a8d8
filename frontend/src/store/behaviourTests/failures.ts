import type { TestFailure, TestReport } from '@/api/types';
import { liveKey, type LiveKey } from '@/store/project/live';
import { openTree } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { reportOf, useTests } from './report';

/** A failure, with the test that it belongs to. */
export interface FailureAt {
  readonly failure: TestFailure;
  readonly test: string;
  readonly file: string;
}

const NONE: readonly FailureAt[] = [];
const byReport = new WeakMap<TestReport, ReadonlyMap<LiveKey, readonly FailureAt[]>>();

/** Returns the failures of a report by the block that they are about. */
export function failuresByBlock(report: TestReport): ReadonlyMap<LiveKey, readonly FailureAt[]> {
  const known = byReport.get(report);
  if (known) return known;
  const found = new Map<LiveKey, FailureAt[]>();
  for (const { name, file, failures } of report.tests) {
    for (const failure of failures) {
      if (failure.node_id === '') continue;
      const key = liveKey(failure.tree, failure.node_id);
      found.set(key, [...(found.get(key) ?? []), { failure, test: name, file }]);
    }
  }
  byReport.set(report, found);
  return found;
}

/** Returns the failures of the last tests that are about a block. */
export function useFailuresOf(key: LiveKey): readonly FailureAt[] {
  const projectId = useProjectStore((state) => state.projectId);
  return useTests((state) => {
    const report = reportOf(state, projectId);
    return (report && failuresByBlock(report).get(key)) ?? NONE;
  });
}

/** Shows the block that a failure is about. */
export function revealFailure({ tree, node_id: node }: TestFailure): void {
  openTree(tree);
  useProjectStore.getState().reveal(tree, node);
}
