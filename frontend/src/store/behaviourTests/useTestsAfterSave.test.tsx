import { act, renderHook, waitFor } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useSavingStore } from '@/store/saving/store';
import { fakeServer, openProject } from '../../../harness/testing';
import { useTests } from './report';
import { isTestFile, useTestsAfterSave } from './useTestsAfterSave';

const report = { tests: [], problems: [], coverage: { share: 1, trees: {} } };

beforeEach(() => {
  useTests.setState(useTests.getInitialState(), true);
  useSavingStore.setState(useSavingStore.getInitialState(), true);
});

function open(texts: Record<string, string>) {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } }, texts });
  const id = useProjectStore.getState().projectId;
  return fakeServer({ [`POST /projects/${id}/test`]: report }).requests;
}

it('knows the files of tests by their names', () => {
  expect(['tests/a.test.yaml', 'tests/b/c.test.yml'].every(isTestFile)).toBe(true);
  expect(['tests/a.yaml', 'a.test.yaml', 'x/tests/a.test.yaml'].some(isTestFile)).toBe(false);
});

it('runs the tests once for each version, however many views follow them', async () => {
  const requests = open({ 'tests/a.test.yaml': 'x' });
  const first = renderHook(useTestsAfterSave);
  renderHook(useTestsAfterSave);
  await waitFor(() => expect(useTests.getState().report).toEqual(report));
  expect(requests).toHaveLength(1);
  first.unmount();
  act(() => useProjectStore.setState(({ changeCounter }) => ({ changeCounter: changeCounter + 1 })));
  await waitFor(() => expect(requests.filter(({ path }) => path.endsWith('/test'))).toHaveLength(2));
});

it('asks for nothing where there are no tests', () => {
  const requests = open({});
  renderHook(useTestsAfterSave);
  expect(requests).toEqual([]);
});
