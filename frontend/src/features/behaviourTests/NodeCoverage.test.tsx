import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import type { TestReport } from '@/api/types';
import { showCoverage } from '@/store/behaviourTests/coverage';
import { useTests } from '@/store/behaviourTests/report';
import { useProjectStore } from '@/store/project';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { NodeCoverage } from './NodeCoverage';

const failure = {
  ...{ message: 'wanted RUNNING, got IDLE', line: 9, tick: 6, time_s: 0.25, node: 'Turn', tree: 'Main' },
  ...{ node_id: 'a', wanted: 'RUNNING', got: 'IDLE', path: [] },
};
const report = {
  tests: [{ name: 'turns', file: 'tests/a.test.yaml', failures: [failure] }],
  coverage: {
    share: 0.5,
    trees: {
      Main: {
        share: 0.5,
        nodes: { a: { name: 'a', type: 'Turn', items: { ticked: true, SUCCESS: false } } },
      },
    },
  },
} as unknown as TestReport;

beforeEach(() => {
  openProject({ trees: { Main: { a: { type: 'Turn' } } } });
  useTests.setState({ project: useProjectStore.getState().projectId, report });
  act(() => showCoverage(false));
});

it('lists what no test reaches, while the coverage is shown', () => {
  act(() => showCoverage(true));
  show(<NodeCoverage tree="Main" node="a" />);
  expect(screen.getByText('Partly covered, 1 of 2')).toBeInTheDocument();
  expect(screen.getByRole('list', { name: 'Not covered' })).toHaveTextContent('It never returns SUCCESS.');
  act(() => showCoverage(false));
  expect(screen.queryByText('Partly covered, 1 of 2')).toBeNull();
});

it('leads from a failure to its line', async () => {
  const { openFile } = watchNavigation();
  show(<NodeCoverage tree="Main" node="a" />);
  await user.click(screen.getByRole('button', { name: /turns.*wanted RUNNING, got IDLE/ }));
  expect(openFile).toHaveBeenCalledExactlyOnceWith('tests/a.test.yaml', 9);
});

it('is absent for a block that tests say nothing about', () => {
  show(<NodeCoverage tree="Main" node="b" />);
  expect(screen.queryByTestId('node-coverage')).toBeNull();
});
