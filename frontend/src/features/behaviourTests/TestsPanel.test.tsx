import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { setLanguage } from '@/i18n';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { useTests } from '@/store/behaviourTests/report';
import { useProjectStore } from '@/store/project';
import { useSavingStore } from '@/store/saving/store';
import { action, fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { TestsPanel } from './TestsPanel';

const FILE = 'tests/main.test.yaml';
const failure = {
  message: 'status after the tick: wanted RUNNING, got IDLE',
  line: 9,
  tick: 6,
  time_s: 0.25,
  node: 'Turn::2',
  tree: 'Main',
  node_id: 'a',
  wanted: 'RUNNING',
  got: 'IDLE',
  path: [
    { name: 'main', status: 'RUNNING' },
    { name: 'Turn', status: 'IDLE' },
  ],
};
const test = { file: FILE, tree: '', ticks: 1, failures: [], reached: {} };
const report = {
  tests: [
    { ...test, name: 'holds', line: 4, outcome: 'passed' },
    {
      ...test,
      name: 'fails',
      line: 7,
      outcome: 'failed',
      failures: [failure, { ...failure, node_id: '', path: [] }],
    },
    { ...test, name: 'real', line: 12, outcome: 'needs_python' },
  ],
  problems: [
    { code: 'TG901', severity: 'error', message: 'No such key.', hint: 'Known are: a', file: FILE, line: 3 },
  ],
  coverage: { share: 0.838, trees: { Main: { share: 0.838, nodes: {} } } },
};

const whole = { ...report, tests: report.tests.map((each) => ({ ...each, outcome: 'passed' })) };

function open(texts: Record<string, string>, answer: object | null = report) {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Turn' } } },
    actions: [action('Turn')],
    texts,
  });
  const { projectId } = useProjectStore.getState();
  const { requests } = fakeServer(
    answer
      ? {
          [`POST /projects/${projectId}/test`]: answer,
          [`POST /projects/${projectId}/test-with-python`]: whole,
        }
      : {},
  );
  const navigation = watchNavigation();
  show(<TestsPanel />);
  return { ...navigation, requests };
}

beforeEach(() => {
  useTests.setState(useTests.getInitialState(), true);
  useSavingStore.setState(useSavingStore.getInitialState(), true);
  setLanguage('en');
});

describe('TestsPanel', () => {
  it('runs the tests with real leaves on request', async () => {
    const { requests } = open({ [FILE]: 'x' });
    await user.click(await screen.findByRole('button', { name: 'Run with Python' }));
    expect(await screen.findByTestId('tests-summary')).toBeInTheDocument();
    await expect
      .poll(() => useTests.getState().report?.tests.map(({ outcome }) => outcome))
      .toEqual(['passed', 'passed', 'passed']);
    expect(requests.some(({ path }) => path.endsWith('/test-with-python'))).toBe(true);
    expect(screen.queryByRole('button', { name: 'Run with Python' })).toBeNull();
  });

  it('writes a first test where there is none', async () => {
    const { openFile, requests } = open({});
    expect(requests).toEqual([]);
    await user.click(screen.getByRole('button', { name: 'Write a test' }));
    expect(openFile).toHaveBeenCalledExactlyOnceWith(FILE, undefined);
    expect(useProjectStore.getState().currentText(FILE)).toContain('Turn: SUCCESS');
  });

  it('runs the tests of a saved project and counts them', async () => {
    open({ [FILE]: 'x' });
    expect(await screen.findByTestId('tests-summary')).toHaveTextContent('1 passed, 2 failed');
    expect(screen.getByRole('status')).toHaveTextContent('83 % of the trees covered');
    const icons = screen.getAllByRole('img').map((icon) => icon.getAttribute('aria-label'));
    expect(icons.map((name) => name?.split(':')[0])).toEqual(['Failed', 'Passed', 'Failed', 'Not run yet']);
  });

  it('runs them again on request', async () => {
    const { requests } = open({ [FILE]: 'x' });
    await screen.findByTestId('tests-summary');
    const before = requests.length;
    await user.click(screen.getByRole('button', { name: 'Run the tests' }));
    expect(requests.length).toBeGreaterThan(before);
  });

  it('leads to the test, to the block that failed, and to the line of an expectation', async () => {
    const { openFile, openTree } = open({ [FILE]: 'x' });
    await user.click(await screen.findByRole('button', { name: /^Failed ?fails/ }));
    expect(openFile).toHaveBeenLastCalledWith(FILE, 7);
    const [block, line] = screen.getAllByRole('button', { name: /Tick 6 \(0.25 s\): status after the tick/ });
    expect(block).toHaveTextContent('main RUNNING › Turn IDLE');
    await user.click(block!);
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'a' });
    await user.click(line!);
    expect(openFile).toHaveBeenLastCalledWith(FILE, 9);
    await user.click(screen.getByRole('button', { name: /No such key/ }));
    expect(openFile).toHaveBeenLastCalledWith(FILE, 3);
  });

  it('says what is before tests that wait for a place', async () => {
    open({ [FILE]: 'x' });
    await screen.findByTestId('tests-summary');
    act(() => useTests.setState({ turn: { before: 2, isOwn: false } }));
    expect(screen.getByText('Your tests wait for a place: 2 are before yours')).toBeInTheDocument();
    act(() => useTests.setState({ turn: { before: 0, isOwn: false } }));
    expect(screen.getByText('Your tests get the next free place')).toBeInTheDocument();
    act(() => useTests.setState({ turn: { before: 0, isOwn: true } }));
    expect(screen.getByText('Your tests wait until other tests of yours have ended')).toBeInTheDocument();
    act(() => useTests.setState({ turn: null }));
    expect(screen.getByTestId('tests-summary')).toBeInTheDocument();
  });

  it('ends tests with Python that wait, and says so', async () => {
    const { requests } = open({ [FILE]: 'x' });
    const { projectId } = useProjectStore.getState();
    await screen.findByTestId('tests-summary');
    expect(screen.queryByTestId('end-tests')).toBeNull();
    act(() => useTests.setState({ isRunning: true, withPython: ['another'] }));
    expect(screen.queryByTestId('end-tests')).toBeNull();
    act(() => useTests.setState({ withPython: [projectId ?? ''], turn: { before: 1, isOwn: false } }));
    await user.click(screen.getByRole('button', { name: 'End' }));
    expect(requests.at(-1)).toMatchObject({
      method: 'DELETE',
      path: `/projects/${projectId}/test-with-python`,
    });
    expect(await screen.findByText('The tests could not be ended')).toBeInTheDocument();
    act(() => useTests.setState({ isRunning: false, withPython: [], turn: null, isEnded: true }));
    expect(screen.getByRole('status')).toHaveTextContent('You have ended the tests');
    expect(screen.queryByTestId('end-tests')).toBeNull();
  });

  it('keeps the focus while tests are ended, and hands it on when they are', async () => {
    open({ [FILE]: 'x' });
    await screen.findByTestId('tests-summary');
    const { projectId } = useProjectStore.getState();
    let answer: (response: Response) => void = () => undefined;
    const ends = new Promise<Response>((resolve) => (answer = resolve));
    const { requests } = fakeServer({ [`DELETE /projects/${projectId}/test-with-python`]: ends });
    act(() => useTests.setState({ withPython: [projectId ?? ''] }));
    const end = screen.getByRole('button', { name: 'End' });
    await user.click(end);
    await user.click(end);
    expect(end).toHaveAttribute('aria-busy', 'true');
    expect(end).toHaveFocus();
    answer(new Response(null, { status: 204 }));
    await expect.poll(() => end.getAttribute('aria-busy')).toBe('false');
    expect(requests).toHaveLength(1);
    act(() => useTests.setState({ withPython: [] }));
    expect(screen.getByRole('button', { name: 'Run the tests' })).toHaveFocus();
  });

  it('says why the tests could not run', async () => {
    open({ [FILE]: 'x' }, null);
    expect(await screen.findByText(/The tests could not run/)).toBeInTheDocument();
  });

  it('shows the coverage of a tree, and of one test', async () => {
    const { openTree } = open({ [FILE]: 'x' });
    await user.click(await screen.findByRole('button', { name: 'Main 83 %' }));
    expect(openTree).toHaveBeenLastCalledWith('Main');
    expect(useCoverage.getState()).toMatchObject({ isShown: true, chosen: null });
    const one = screen.getByRole('button', { name: 'Show what “holds” covers' });
    await user.click(one);
    expect(useCoverage.getState().chosen).toBe(`${FILE}: holds`);
    expect(one).toHaveAttribute('aria-pressed', 'true');
    await user.click(one);
    expect(useCoverage.getState().isShown).toBe(false);
    expect(screen.queryByRole('button', { name: /what “real” covers/ })).toBeNull();
  });

  it('follows the language', async () => {
    open({ [FILE]: 'x' });
    await screen.findByTestId('tests-summary');
    act(() => setLanguage('es'));
    expect(screen.getByTestId('tests-summary')).toHaveTextContent('1 superadas, 2 fallidas');
  });
});
