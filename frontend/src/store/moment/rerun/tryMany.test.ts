import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { hidePaths, useShownPaths } from '@/store/session/trace/shownPaths';
import { beginJob, changeJob, choosePath, useTries } from '@/store/session/tries';
import { segmentOf } from '../../../../harness/runs';
import { outcomeOf, place } from '../../../../harness/tries';
import { ofSession, useSource } from '../source';
import { atPresent, useMoment } from '../store';
import {
  askTries,
  beginSeeds,
  beginTries,
  canTry,
  drawTries,
  openAsBranch,
  stopTries,
  useTryMany,
} from './tryMany';

let send: MockInstance<typeof connection.send>;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    connection: 'open',
    introspection: { role: 'driver' } as Introspection,
    segments: [segmentOf({ run: 'a', to_t: 8 })],
    repeatableRuns: ['a'],
  });
  useMoment.setState({ t: 3.25 });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useSource.setState(ofSession);
  useTries.setState({ job: null });
  useTryMany.setState({ asking: null });
});

it('is offered at a past moment of an exact run', () => {
  expect(canTry()).toBe(true);
  askTries(null);
  expect(useTryMany.getState().asking).toMatchObject({ run: 'a', t: 3.25, blocks: [], uid: null });
  useSessionStore.setState({ liveRuns: ['a'] });
  expect(canTry()).toBe(false);
  useSessionStore.setState({ liveRuns: [] });
  useMoment.setState({ t: null });
  expect(canTry()).toBe(false);
});

it('sends the values, and stops', async () => {
  await beginTries(place, ['1', '2'], 4);
  const job = useTries.getState().job?.id;
  expect(job).toMatch(/^[0-9a-f]{16}$/);
  expect(send).toHaveBeenCalledWith('try_values', {
    job,
    run: 'a',
    t: 3.25,
    node_id: 'n6',
    path: 'Forward::6',
    port: 'lin_speed',
    values: ['1', '2'],
    duration_s: 4,
  });
  stopTries();
  expect(send).toHaveBeenCalledWith('stop_trying', { job });
});

it('says why it is refused', async () => {
  send.mockRejectedValue(new CommandError('live_run', 'A live run.', 'Make it exact.'));
  await beginTries(place, ['1'], 4);
  expect(useTries.getState().job?.ended).toMatchObject({
    end: 'refused',
    message: 'A live run. Make it exact.',
  });
  send.mockClear();
  stopTries();
  expect(send).not.toHaveBeenCalled();
});

it('opens a row as a branch: back, the value, and on', async () => {
  beginJob('a1', place, ['2']);
  const { job } = useTries.getState();
  await openAsBranch(job!, '2');
  expect(send.mock.calls.map(([command]) => command)).toEqual(['go_back', 'set_port', 'resume']);
  expect(send).toHaveBeenCalledWith('set_port', {
    node_id: 'n6',
    path: 'Forward::6',
    port: 'lin_speed',
    value: '2',
  });
  expect(useMoment.getState().t).toBeNull();
  send.mockClear();
  await openAsBranch(job!, null);
  expect(send.mock.calls.map(([command]) => command)).toEqual(['go_back', 'resume']);
});

it('sends seeds', async () => {
  await beginSeeds({ run: 'a', t: 3.25 }, ['7', '8'], 4);
  const { job } = useTries.getState();
  expect(job).toMatchObject({ place: null, values: ['7', '8'] });
  const order = { job: job!.id, run: 'a', t: 3.25, seeds: [7, 8], duration_s: 4 };
  expect(send).toHaveBeenCalledWith('try_seeds', order);
});

it('draws the chosen paths in 3D, with what was tried', () => {
  beginJob('a1', place, ['1', '2']);
  changeJob('a1', () => ({ outcomes: [outcomeOf(0), outcomeOf(1), outcomeOf(2)] }));
  choosePath(1, false);
  drawTries(useTries.getState().job!);
  const { owner, paths } = useShownPaths.getState();
  expect(owner).toBe('tries');
  expect(paths.map(({ label, name, isDashed }) => [label, name, isDashed])).toEqual([
    ['0', 'as it is', true],
    ['2', 'lin_speed = 2', false],
  ]);
  expect([...paths[1]!.lines[0]!]).toEqual([0, 0, 3.25, 1, 2, 1, 7.25, 0]);
  hidePaths('tries');
});
