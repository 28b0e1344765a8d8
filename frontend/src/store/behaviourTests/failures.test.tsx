import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { TestFailure, TestReport } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { openProject, show, watchNavigation } from '../../../harness/testing';
import { failuresByBlock, revealFailure, useFailuresOf } from './failures';
import { useTests } from './report';

const failure = (node_id: string) => ({ tree: 'Main', node_id, line: 3 }) as TestFailure;
const report = {
  tests: [
    { name: 'one', file: 'f', failures: [failure('a'), failure('')] },
    { name: 'two', file: 'f', failures: [failure('a'), failure('b')] },
  ],
} as TestReport;

it('finds the failures of each block, and leaves out those that are about none', () => {
  const found = failuresByBlock(report);
  expect([...found].map(([key, all]) => [key, all.map(({ test }) => test)])).toEqual([
    ['Main/a', ['one', 'two']],
    ['Main/b', ['two']],
  ]);
  expect(failuresByBlock(report)).toBe(found);
});

const Shown = () => <output>{useFailuresOf('Main/a').length}</output>;

it('has those of the open project alone', () => {
  openProject({ trees: { Main: { a: { type: 'AlwaysSuccess' } } } });
  useTests.setState({ project: 'another', report });
  const { unmount } = show(<Shown />);
  expect(screen.getByRole('status')).toHaveTextContent('0');
  unmount();
  useTests.setState({ project: useProjectStore.getState().projectId, report });
  show(<Shown />);
  expect(screen.getByRole('status')).toHaveTextContent('2');
});

it('shows the block of a failure', () => {
  openProject({ trees: { Main: { a: { type: 'AlwaysSuccess' } } } });
  const { openTree } = watchNavigation();
  revealFailure(failure('a'));
  expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
  expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'a' });
});
