import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { useRunStore } from '@/store/run/store';
import { fakeServer, openProject } from '../../../../harness/testing';
import { segmentOf } from '../../../../harness/runs';
import { canGoBack, cancelGoBack, canRunOn, changedByHandAt, goBack, runOn } from './goBack';
import { ofSession, useSource } from '../source';
import { atPresent, useMoment } from '../store';

let send: MockInstance<typeof connection.send>;
const plan = { dry: true, kept: 1, renewed: [], added: [], removed: [], halted: [], late_ports: [] };
const driver = { role: 'driver' } as Introspection;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    connection: 'open',
    introspection: driver,
    segments: [segmentOf({ run: 'a', to_t: 8 })],
    repeatableRuns: ['a'],
  });
  useMoment.setState({ t: 3.25 });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useSource.setState(ofSession);
  useRunStore.setState({ failure: null });
});

it('takes the run back to the shown moment, and shows the present, which is there', async () => {
  await goBack();
  expect(send).toHaveBeenCalledWith('go_back', { run: 'a', t: 3.25 });
  expect(useMoment.getState().t).toBeNull();
});

it('is possible at a past moment of an exact run, for its driver, while none is on its way', () => {
  expect(canGoBack()).toBe(true);
  useSessionStore.setState({ goingBack: 0.4 });
  expect(canGoBack()).toBe(false);
  useSessionStore.setState({ goingBack: null, repeatableRuns: ['b'] });
  expect(canGoBack()).toBe(false);
  useSessionStore.setState({ repeatableRuns: ['a'], introspection: { role: 'viewer' } as Introspection });
  expect(canGoBack()).toBe(false);
  useSessionStore.setState({ introspection: driver, connection: 'lost' });
  expect(canGoBack()).toBe(false);
  useSessionStore.setState({ connection: 'open' });
  useMoment.setState({ t: null });
  expect(canGoBack()).toBe(false);
  useMoment.setState({ t: 1 });
  useSource.setState({ kept: { id: 'k', name: 'kept' } });
  expect(canGoBack()).toBe(false);
});

it('is not possible from the moment on at which the debugger changed the program', async () => {
  useSessionStore.setState({ runsByHand: { a: 3.25, b: 0 } });
  expect(changedByHandAt()).toBe(3.25);
  expect(canGoBack()).toBe(false);
  await goBack();
  expect(send).not.toHaveBeenCalled();
  useMoment.setState({ t: 3.2 });
  expect(changedByHandAt()).toBeNull();
  expect(canGoBack()).toBe(true);
  useMoment.setState({ t: null });
  expect(changedByHandAt()).toBeNull();
});

it('sends nothing where it is not possible', async () => {
  useMoment.setState({ t: null });
  await goBack();
  expect(send).not.toHaveBeenCalled();
});

it('shows why it was refused', async () => {
  send.mockRejectedValue(new CommandError('not_repeatable', 'This run is too long.', 'Press Run.'));
  await goBack();
  expect(useRunStore.getState().failure).toMatchObject({
    message: 'This run is too long.',
    hint: 'Press Run.',
  });
});

it('can be cancelled', async () => {
  await cancelGoBack();
  expect(send).toHaveBeenCalledWith('cancel', {});
});

it('runs on from the shown moment, or from where the run is paused, but only as the driver', () => {
  expect(canRunOn()).toBe(true);
  useSessionStore.setState({ repeatableRuns: [] });
  expect(canRunOn()).toBe(false);
  useMoment.setState({ t: null });
  expect(canRunOn()).toBe(false);
  useSessionStore.setState({ executor: 'paused' });
  expect(canRunOn()).toBe(true);
  useRunStore.setState({ stage: 'launching' });
  expect(canRunOn()).toBe(false);
  useRunStore.setState({ stage: null });
  useSessionStore.setState({ introspection: { role: 'viewer' } as Introspection });
  expect(canRunOn()).toBe(false);
});

it('saves and checks the project, goes back, and runs on with it', async () => {
  openProject({});
  fakeServer({ 'GET /projects/p1/app': { app_zip_base64: 'eA==', universe: {} } });
  send.mockImplementation((command) => {
    // The plan comes a frame after the reply.
    if (command === 'apply') setTimeout(() => useSessionStore.setState({ applied: plan }));
    return Promise.resolve();
  });
  await runOn();
  expect(send.mock.calls).toEqual([
    ['go_back', { run: 'a', t: 3.25 }],
    ['apply', { app_zip_base64: 'eA==', dry: true }],
    ['run_on', { app_zip_base64: 'eA==' }],
  ]);
  expect(useRunStore.getState().stage).toBeNull();
});

it('goes nowhere with a project that has errors', async () => {
  openProject({
    diagnostics: [{ code: 'BT0601', severity: 'error', message: 'bad', hint: 'Correct it.' }],
  });
  fakeServer({});
  await runOn();
  expect(send).not.toHaveBeenCalled();
  expect(useMoment.getState().t).toBe(3.25);
  expect(useRunStore.getState().failure).toMatchObject({ message: 'bad' });
});

it('stays where it is if the tree is refused', async () => {
  useMoment.setState({ t: null });
  useSessionStore.setState({ executor: 'paused' });
  openProject({});
  fakeServer({ 'GET /projects/p1/app': { app_zip_base64: 'eA==', universe: {} } });
  send.mockRejectedValue(new CommandError('not_applied', 'It is no tree.', 'Mend it.'));
  await runOn();
  expect(send.mock.calls).toEqual([['apply', { app_zip_base64: 'eA==', dry: true }]]);
  expect(useRunStore.getState().failure).toMatchObject({ message: 'It is no tree.' });
});
