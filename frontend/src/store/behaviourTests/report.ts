import { create } from 'zustand';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { TestReport } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { saveNow } from '@/store/saving/autosave';

export interface TestsData {
  /** The project that the report is about. */
  readonly project: string | null;
  readonly report: TestReport | null;
  readonly isRunning: boolean;
  /** The reason for which the last attempt gave no report. */
  readonly refused: string | null;
  /** The project and the count of its changes that the last request was about. */
  readonly asked: string | null;
}

const initial: TestsData = { project: null, report: null, isRunning: false, refused: null, asked: null };

export const useTests = create<TestsData>(() => initial);

/** Returns the report of the open project; null if there is none yet. */
export const reportOf = ({ project, report }: TestsData, projectId: string | null): TestReport | null =>
  project === projectId ? report : null;

/** The number of the last request: answers to earlier ones come too late. */
let last = 0;

const versionNow = (): string => {
  const { projectId, changeCounter } = useProjectStore.getState();
  return `${projectId} ${changeCounter}`;
};

/** The outcome of a test that runs Python of the project, and was left out. */
export const NEEDS_PYTHON = 'needs_python';

/**
 * Saves the project and runs its behaviour tests on the server; with `withPython` also those with leaves that
 * are `real`, where the user's own programs run.
 */
export async function runTests({ withPython = false } = {}): Promise<void> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) return;
  const number = ++last;
  const isCurrent = () => number === last && useProjectStore.getState().projectId === projectId;
  if (useTests.getState().project !== projectId) useTests.setState({ ...initial, project: projectId });
  useTests.setState({ isRunning: true, asked: versionNow() });
  try {
    await saveNow();
    const report = await (withPython ? api.testWithPython(projectId) : api.test(projectId));
    if (isCurrent()) useTests.setState({ report, refused: null });
  } catch (error) {
    if (isCurrent()) useTests.setState({ refused: reasonOf(error) });
  } finally {
    if (number === last) useTests.setState({ isRunning: false });
  }
}

/** Runs the tests unless they were run for the project as it is now. */
export async function runChangedTests(): Promise<void> {
  if (useTests.getState().asked !== versionNow()) await runTests();
}

const reasonOf = (error: unknown): string =>
  error instanceof ApiError ? error.message : error instanceof Error ? error.message : String(error);
