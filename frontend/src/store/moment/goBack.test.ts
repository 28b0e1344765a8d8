import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { useRunStore } from '@/store/run/store';
import { segmentOf } from '../../../harness/runs';
import { canGoBack, cancelGoBack, goBack } from './goBack';
import { ofSession, useSource } from './source';
import { atPresent, useMoment } from './store';

let send: MockInstance<typeof connection.send>;
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
