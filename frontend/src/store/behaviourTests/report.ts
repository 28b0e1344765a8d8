import { create } from 'zustand';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { TestReport } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { saveNow } from '@/store/saving/autosave';

/** What is before tests with Python that wait for a place. */
interface Turn {
  /** So many tests get a place before. */
  readonly before: number;
  /** Whether they wait until another test of the same user ends. */
  readonly isOwn: boolean;
}

export interface TestsData {
  /** The project that the report is about. */
  readonly project: string | null;
  readonly report: TestReport | null;
  readonly isRunning: boolean;
  /** The project of each of the page's tests with Python that run or wait: the user can end them. */
  readonly withPython: readonly string[];
  /** What is before the user's tests with Python; null while they do not wait for a place. */
  readonly turn: Turn | null;
  /** The reason for which the last attempt gave no report. */
  readonly refused: string | null;
  /** Whether the user ended the last attempt, here or in another tab. */
  readonly isEnded: boolean;
  /** The project and the count of its changes that the last request was about. */
  readonly asked: string | null;
}

const initial: TestsData = {
  project: null,
  report: null,
  isRunning: false,
  withPython: [],
  turn: null,
  refused: null,
  isEnded: false,
  asked: null,
};
const TURN_EVERY_MS = 1000;
const END_AGAIN_MS = 500;
/** The code of the answer to tests that the user ended. */
const ENDED = 'tests_ended';
/** The code of the answer that none of the user's tests run or wait. */
const NONE_TO_END = 'no_tests';

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
  const { project, withPython: pending } = useTests.getState();
  if (project !== projectId) useTests.setState({ ...initial, withPython: pending, project: projectId });
  useTests.setState({ isRunning: true, isEnded: false, turn: null, asked: versionNow() });
  if (withPython) useTests.setState({ withPython: [...pending, projectId] });
  const ended = new AbortController();
  if (withPython) void followTurn(projectId, ended.signal, isCurrent);
  try {
    await saveNow();
    const report = await (withPython ? api.testWithPython(projectId) : api.test(projectId));
    if (isCurrent()) useTests.setState({ report, refused: null });
  } catch (error) {
    const isEnded = error instanceof ApiError && error.code === ENDED;
    if (isCurrent()) useTests.setState({ refused: isEnded ? null : reasonOf(error), isEnded });
  } finally {
    ended.abort();
    if (number === last) useTests.setState({ isRunning: false, turn: null });
    if (withPython)
      useTests.setState(({ withPython: others }) => ({ withPython: without(others, projectId) }));
  }
}

/**
 * Ends the user's tests with Python of the open project, which run or wait; the attempt then says so.
 *
 * The server knows them only after the save and the tests without Python: until then it is asked again.
 *
 * @throws They cannot be ended. That they have just ended by themselves is no error.
 */
export async function endTests(): Promise<void> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) return;
  do {
    try {
      return await api.endTests(projectId);
    } catch (error) {
      if (!(error instanceof ApiError && error.code === NONE_TO_END)) throw error;
    }
  } while (await stillRun(projectId));
}

/** Returns whether tests with Python of a project still run after a while; that they do not, at once. */
function stillRun(projectId: string): Promise<boolean> {
  const hasSome = ({ withPython }: TestsData) => withPython.includes(projectId);
  if (!hasSome(useTests.getState())) return Promise.resolve(false);
  return new Promise((resolve) => {
    const done = (value: boolean) => {
      clearTimeout(timer);
      unsubscribe();
      resolve(value);
    };
    const timer = setTimeout(() => done(true), END_AGAIN_MS);
    const unsubscribe = useTests.subscribe((state) => {
      if (!hasSome(state)) done(false);
    });
  });
}

/** Returns a list without one of its items that is equal to this. */
function without(items: readonly string[], item: string): readonly string[] {
  const at = items.indexOf(item);
  return items.filter((_, index) => index !== at);
}

/** Asks what is before the tests, each second while they run or wait. */
async function followTurn(projectId: string, signal: AbortSignal, isCurrent: () => boolean): Promise<void> {
  for (;;) {
    await new Promise((resolve) => {
      setTimeout(resolve, TURN_EVERY_MS);
    });
    if (signal.aborted || !isCurrent()) return;
    const turn = await turnOf(projectId, signal);
    if (!signal.aborted && isCurrent()) useTests.setState({ turn });
  }
}

/** Returns what is before the user's tests of a project; null if none of them waits, or nobody knows. */
async function turnOf(projectId: string, signal: AbortSignal): Promise<Turn | null> {
  try {
    const { position, waits_for_own: isOwn } = await api.testTurn(projectId, signal);
    return position === null ? null : { before: Math.max(0, position - 1), isOwn };
  } catch {
    return null;
  }
}

/** Runs the tests unless they were run for the project as it is now. */
export async function runChangedTests(): Promise<void> {
  if (useTests.getState().asked !== versionNow()) await runTests();
}

const reasonOf = (error: unknown): string =>
  error instanceof ApiError ? error.message : error instanceof Error ? error.message : String(error);
