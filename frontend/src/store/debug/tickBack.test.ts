import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { useRunStore } from '@/store/run/store';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';
import { attached } from '../../../harness/attached';
import { tickBack, whyNoTickBack } from './tickBack';

let send: MockInstance<typeof connection.send>;
const introspect = (role: Introspection['role']) => ({ role }) as Introspection;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    executor: 'paused',
    introspection: introspect('driver'),
    repeatableRuns: ['a', 'b'],
    liveRuns: ['a'],
  });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useRunStore.setState({ failure: null });
});

it('is one command of the session', async () => {
  expect(whyNoTickBack()).toBeNull();
  useSessionStore.setState({ executor: 'held' });
  expect(whyNoTickBack()).toBeNull();
  await tickBack();
  expect(send.mock.calls).toEqual([['tick_back', {}]]);
});

it.each<[string, Partial<SessionData>]>([
  ['live', { liveRuns: ['a', 'b'] }],
  ['running', { executor: 'application_running' }],
  ['running', { executor: 'visualization_ready' }],
  ['viewer', { introspection: introspect('viewer') }],
  ['attached', { attached: attached({ controls: true }) }],
  ['going', { executor: 'visualization_ready', goingBack: 0.3 }],
])('is not possible, and says why: %s %o', (why, state) => {
  useSessionStore.setState(state);
  expect(whyNoTickBack()).toBe(why);
});

it('goes back one press after the other', async () => {
  const waiting: (() => void)[] = [];
  send.mockImplementation(() => new Promise((resolve) => waiting.push(() => resolve(undefined))));
  const both = [tickBack(), tickBack()];
  await vi.waitFor(() => expect(waiting).toHaveLength(1));
  await Promise.resolve();
  expect(send).toHaveBeenCalledTimes(1);
  waiting[0]?.();
  await vi.waitFor(() => expect(waiting).toHaveLength(2));
  waiting[1]?.();
  await Promise.all(both);
});

it('is of the present, not of the shown past', () => {
  useMoment.setState({ t: 1 });
  expect(whyNoTickBack()).toBe('past');
});

it('shows why the session refuses it: at the begin of a run, or after a change by hand', async () => {
  send.mockRejectedValue(new CommandError('first_tick', 'This is the begin of the run.', ''));
  await tickBack();
  expect(useRunStore.getState().failure).toMatchObject({ message: 'This is the begin of the run.' });
});
