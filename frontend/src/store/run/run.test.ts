import { afterEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, openSession } from '../../../harness/testing';
import { useApplyQuestion } from './apply';
import { applyProject, runProject } from './run';
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

it('runs the project as the server gives it, with the revision that a recording names', async () => {
  const ofTests = {
    code: 'TG905',
    severity: 'error',
    message: 'no leaf',
    file: 'tests/a.test.yaml',
  } as const;
  openProject({ diagnostics: [ofTests] }); // what is wrong with a test keeps nobody from running
  const executor = await openSession();
  const application = {
    app_zip_base64: 'eA==',
    tick_hz: 20,
    on_finish: 'stop',
    on_error: 'stop',
    revision: 7,
  };
  fakeServer({ 'GET /projects/p1/app': { ...application, time: 'live', universe: 'empty', robot: null } });
  expect(await runProject()).toBe(true);
  expect(executor.sentAs('run')).toMatchObject([{ application }]);
});

const plan = { dry: true, kept: 1, renewed: [], added: [], removed: [], halted: [], late_ports: [] };
const node = { path: 'Drive', node_id: 'd', tree_id: 'Main' };

it.each([
  ['applies at once what halts nothing', [], null, [true, false]],
  ['asks before something is halted, and applies it', [node], true, [true, false]],
  ['asks before something is halted, and leaves it', [node], false, [true]],
] as const)('%s', async (_, halted, answer, sent) => {
  openProject({});
  useRunStore.setState({ ranAt: -1 });
  const executor = await openSession();
  fakeServer({ 'GET /projects/p1/app': { app_zip_base64: 'eA==', universe: {} } });
  executor.emit('state-changed', { state: 'application_running', reason: '' });
  const confirm = executor.takeLong('apply');
  const applied = applyProject();
  await expect.poll(() => executor.sentAs('apply')).toHaveLength(1);
  expect(useRunStore.getState().stage).toBe('applying');
  confirm();
  executor.emit('applied', { ...plan, halted: [...halted] });
  if (answer !== null) {
    await expect.poll(() => useApplyQuestion.getState().plan?.halted).toEqual(halted);
    expect(useRunStore.getState().stage).toBeNull();
    useApplyQuestion.getState().answer(answer);
  }
  await expect.poll(() => executor.sentAs('apply').length).toBe(sent.length);
  if (sent.length > 1) confirm();
  expect(await applied).toBe(answer !== false);
  expect(executor.sentAs('apply')).toEqual(sent.map((dry) => ({ app_zip_base64: 'eA==', dry })));
  const { changeCounter } = useProjectStore.getState();
  expect(useRunStore.getState().ranAt === changeCounter).toBe(answer !== false);
});

it('says of a change that is refused that nothing was changed, not that no run was started', async () => {
  const error = { code: 'BT0601', severity: 'error', message: 'bad', hint: '' } as const;
  openProject({ diagnostics: [error] });
  fakeServer({});
  expect(await applyProject()).toBe(false);
  expect(useRunStore.getState().failure).toMatchObject({ stage: 'checking', isChange: true });
});

it('shows no error where the user cancelled the start', async () => {
  openProject({});
  const executor = await openSession();
  fakeServer({ 'GET /projects/p1/app': { app_zip_base64: 'eA==', universe: {} } });
  executor.refuse('run', 'run was cancelled.', '', 'cancelled');
  expect(await runProject()).toBe(false);
  expect(useRunStore.getState().failure).toBeNull();
});
