import { beforeEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject } from '../../../harness/testing';
import { runTests, useTests } from './report';

const report = { tests: [], problems: [], coverage: { share: 1, trees: {} } };

beforeEach(() => {
  useTests.setState(useTests.getInitialState(), true);
});

it('keeps the report of the open project', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId;
  const { requests } = fakeServer({ [`POST /projects/${id}/test`]: report });
  await runTests();
  expect(useTests.getState()).toEqual({
    project: id,
    report,
    isRunning: false,
    refused: null,
    asked: `${id} 0`,
  });
  expect(requests.at(-1)?.body).toEqual({ files: [] });
});

it('says why there is no report', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  fakeServer({});
  await runTests();
  expect(useTests.getState()).toMatchObject({ report: null, isRunning: false });
  expect(useTests.getState().refused).toBeTruthy();
});

it('does nothing without a project', async () => {
  await runTests();
  expect(useTests.getState().project).toBeNull();
});

it('runs the tests with Python of the project only on request', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId;
  const { requests } = fakeServer({ [`POST /projects/${id}/test-with-python`]: report });
  await runTests({ withPython: true });
  expect(useTests.getState()).toMatchObject({ report, refused: null });
  expect(requests.at(-1)?.body).toEqual({ files: [] });
});
