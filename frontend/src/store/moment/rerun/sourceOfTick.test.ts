import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import type { Moment } from '@/store/recording/types';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { loseSource, useTickSource } from '@/store/session/trace/tickSource';
import { segmentOf } from '../../../../harness/runs';
import { usePastTree } from '../pastTree';
import { ofSession, useSource } from '../source';
import { atPresent, useMoment } from '../store';
import { askSource, canShowSource, showSource, sourceAt, stopSource, whyNoSource } from './sourceOfTick';

let send: MockInstance<typeof connection.send>;
const job = () => useTickSource.getState().job;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    connection: 'open',
    introspection: { role: 'driver' } as Introspection,
    segments: [segmentOf({ run: 'a', to_t: 8 })],
    repeatableRuns: ['a'],
  });
  useMoment.setState({ t: 3.27, shown: { t: 3.27, tickT: 3.25 } as Moment });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useSource.setState(ofSession);
  loseSource();
});

it('asks once for the tick of the shown moment', () => {
  showSource();
  showSource();
  expect(usePastTree.getState().view).toBe('source');
  expect(send).toHaveBeenCalledExactlyOnceWith('source_of_tick', { job: job()?.id, run: 'a', t: 3.25 });
  expect(sourceAt(job(), 3.25)).toBe(job());
  expect(sourceAt(job(), 3.3)).toBeNull();
  stopSource();
  expect(send).toHaveBeenLastCalledWith('stop_source', { job: job()?.id });
});

it('says why it is refused', async () => {
  send.mockRejectedValue(new CommandError('changed_by_hand', 'Changed.', 'Look at an earlier tick.'));
  await askSource();
  expect(job()?.found?.problem).toBe('Changed. Look at an earlier tick.');
  send.mockClear();
  stopSource();
  expect(send).not.toHaveBeenCalled();
});

it('is for the ticks of exact runs of the session, by the driver', async () => {
  expect(canShowSource()).toBe(true);
  useMoment.setState({ shown: { t: 0, tickT: null } as Moment });
  expect(whyNoSource()).toBe('noTick');
  useSessionStore.setState({ goingBack: 0.5 });
  expect(whyNoSource()).toBe('unrepeatable');
  useSessionStore.setState({ liveRuns: ['a'] });
  expect(whyNoSource()).toBe('live');
  useSessionStore.setState({ introspection: { role: 'viewer' } as Introspection });
  expect(whyNoSource()).toBe('viewer');
  useSource.setState({ kept: { id: '7', name: 'kept' } });
  expect(whyNoSource()).toBe('kept');
  useMoment.setState({ shown: null });
  expect(whyNoSource()).toBe('present');
  await askSource();
  expect(send).not.toHaveBeenCalled();
});
