import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { showCoverage, showEvaluated, useCoverage } from '@/store/behaviourTests/coverage';
import { useTests } from '@/store/behaviourTests/report';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { CoverageLegend } from './CoverageLegend';

const one = { file: 'tests/a.test.yaml', line: 1, tree: '', ticks: 1, failures: [] };
const report = {
  tests: [
    { ...one, name: 'turns', outcome: 'passed', reached: { Main: { r: ['ticked', 'SUCCESS'] } } },
    { ...one, name: 'real', outcome: 'needs_python', reached: {} },
  ],
  problems: [],
  coverage: {
    share: 2 / 3,
    trees: {
      Main: {
        share: 2 / 3,
        nodes: {
          r: { name: 'r', type: 'AlwaysSuccess', items: { ticked: true, SUCCESS: true } },
          a: { name: 'a', type: 'AlwaysSuccess', items: { ticked: false } },
        },
      },
    },
  },
};

function open(texts: Record<string, string> = { 'tests/a.test.yaml': 'x' }, answer: object | null = report) {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } }, Other: {} }, texts });
  const id = useProjectStore.getState().projectId;
  fakeServer(answer ? { [`POST /projects/${id}/test`]: answer } : {});
  act(() => showCoverage(true));
  show(<CoverageLegend treeId="Main" />);
}

beforeEach(() => {
  useTests.setState(useTests.getInitialState(), true);
});

it('shows the share of the tree with the count of each level', async () => {
  open();
  expect(await screen.findByText('66 %')).toBeInTheDocument();
  expect(screen.getAllByRole('listitem').map((item) => item.textContent)).toEqual([
    '1 never',
    '0 partly',
    '1 fully',
  ]);
});

it('offers the tests that ran, and shows that of one', async () => {
  open();
  const choice = await screen.findByRole('combobox', { name: 'Tests whose coverage is shown' });
  await screen.findByRole('option', { name: 'turns' });
  expect(screen.queryByRole('option', { name: 'real' })).toBeNull();
  await user.selectOptions(choice, 'turns');
  expect(useCoverage.getState().chosen).toBe('tests/a.test.yaml: turns');
});

it('goes with one press', async () => {
  open();
  await user.click(screen.getByRole('button', { name: 'Hide the coverage (Alt+C)' }));
  expect(screen.queryByTestId('coverage-legend')).toBeNull();
  expect(useCoverage.getState().isShown).toBe(false);
});

it('says why there is nothing to see', async () => {
  open({});
  expect(screen.getByText(/no tests yet/)).toBeInTheDocument();
});

it('says why the tests did not run', async () => {
  open(undefined, null);
  expect(await screen.findByText(/The tests could not run/)).toBeInTheDocument();
});

it('says that no test runs a tree', async () => {
  open(undefined, { ...report, coverage: { share: 1, trees: {} } });
  expect(await screen.findByText(/No test runs this tree/)).toBeInTheDocument();
});

it('shows what the runs of an evaluation covered, until it is closed', async () => {
  open();
  act(() => showEvaluated({ name: 'room', revision: 3, runs: 50, coverage: report.coverage }));
  expect(screen.getByText('room, revision 3: 50 runs')).toBeInTheDocument();
  expect(screen.queryByRole('combobox')).toBeNull();
  expect(screen.getByText('66 %')).toBeInTheDocument();
  // Results of tests that arrive meanwhile change nothing of it.
  act(() => useTests.setState({ report: null }));
  expect(screen.getByText('66 %')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Hide the coverage (Alt+C)' }));
  expect(useCoverage.getState()).toMatchObject({ isShown: false, evaluated: null });
});

it('says if the runs do not reach the tree', () => {
  open();
  const coverage = { share: 1, trees: {} };
  act(() => showEvaluated({ name: 'room', revision: 3, runs: 1, coverage }));
  expect(screen.getByText('The runs do not reach this tree.')).toBeInTheDocument();
});
