import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { fakeServer, openProject } from '../../../harness/testing';
import { tryTest, writeTest } from './writeMoment';

const FILE = 'tests/a.test.yaml';
const outcome = (more: object) => ({
  file: FILE,
  name: 'new',
  line: 4,
  tree: '',
  ticks: 1,
  failures: [],
  ...more,
});

function open(answer: object) {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId;
  return fakeServer({ [`POST /projects/${id}/test`]: answer }).requests;
}

it('tries a file that is not stored', async () => {
  const requests = open({ tests: [outcome({ outcome: 'passed' })], problems: [] });
  expect(await tryTest(FILE, 'text', 'new')).toEqual({ outcome: 'passed', reason: '' });
  expect(requests.at(-1)?.body).toEqual({ files: [{ path: FILE, content: 'text' }] });
});

it('says why it fails, or cannot be read', async () => {
  const failures = [{ node: 'Turn', message: 'wanted A, got B' }];
  open({ tests: [outcome({ outcome: 'failed', failures })], problems: [] });
  expect(await tryTest(FILE, 'text', 'new')).toEqual({ outcome: 'failed', reason: 'Turn: wanted A, got B' });
  open({ tests: [], problems: [{ file: FILE, message: 'No node', hint: 'write one' }] });
  expect(await tryTest(FILE, 'text', 'new')).toEqual({ outcome: 'unread', reason: 'No node: write one' });
});

it('is one step that can be undone', () => {
  open({});
  const undo = writeTest(FILE, 'text');
  expect(useProjectStore.getState().currentText(FILE)).toBe('text');
  undo();
  expect(useProjectStore.getState().currentText(FILE)).toBeNull();
  useProjectStore.getState().addFile(FILE, 'before');
  writeTest(FILE, 'after')();
  expect(useProjectStore.getState().currentText(FILE)).toBe('before');
});

it('leaves a running program up to date, and an outdated one outdated', () => {
  open({});
  const isOutdated = () => useRunStore.getState().ranAt !== useProjectStore.getState().changeCounter;
  useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
  const undo = writeTest(FILE, 'text');
  expect(isOutdated()).toBe(false);
  undo();
  expect(isOutdated()).toBe(false);
  useRunStore.setState({ ranAt: -1 });
  writeTest(FILE, 'text');
  expect(isOutdated()).toBe(true);
});
