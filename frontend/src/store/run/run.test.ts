import { afterEach, expect, it } from 'vitest';
import { fakeServer, openProject } from '../../../harness/testing';
import { runProject } from './run';
import { useRunStore } from './store';

afterEach(() => useRunStore.setState(useRunStore.getInitialState(), true));

it('does not ask the server to run a project in which the last save found errors', async () => {
  const { requests } = fakeServer({});
  const error = { code: 'BT0601', severity: 'error', message: 'bad', hint: 'Correct it.' } as const;
  openProject({ diagnostics: [error, { ...error, severity: 'warning' }] });
  expect(await runProject()).toBe(false);
  expect(requests).toEqual([]);
  expect(useRunStore.getState()).toMatchObject({
    stage: null,
    failure: { stage: 'checking', code: 'check_failed', message: 'bad', diagnostics: [error] },
  });
});
