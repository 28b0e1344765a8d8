import { afterEach, expect, it } from 'vitest';
import type { ServerMessage } from '@/generated/messages';
import { outcomeOf, place } from '../../../harness/tries';
import { beginJob, choosePath, feedTries, loseJob, useTries } from './tries';

const said = (command: string, data: unknown) =>
  feedTries({ id: '', command, data, seq: 0, t: 0 } as ServerMessage);

afterEach(() => useTries.setState({ job: null }));

it('follows a job from its begin to its end', () => {
  beginJob('a1', place, ['1', '2']);
  said('trying_progress', { job: 'a1', stage: 'going_back', fraction: 0.5 });
  expect(useTries.getState().job).toMatchObject({ stage: 'going_back', fraction: 0.5, started: null });
  said('trying_started', { job: 'a1', t: 3.25, at_once: 1, outlines: [] });
  for (const index of [2, 0, 1]) said('try_outcome', outcomeOf(index));
  said('tick', {});
  expect(useTries.getState().job?.outcomes.map(({ index }) => index)).toEqual([0, 1, 2]);
  said('trying_ended', { job: 'a1', end: 'complete', message: '' });
  said('trying_progress', { job: 'a1', stage: 'continuing', fraction: 0.1 });
  expect(useTries.getState().job).toMatchObject({
    stage: 'continuing',
    fraction: 0,
    ended: { end: 'complete' },
  });
});

it('keeps which paths are drawn, also after its end', () => {
  beginJob('a1', { run: 'a', t: 3 }, ['7']);
  expect(useTries.getState().job).toMatchObject({ moment: { run: 'a', t: 3 }, place: null, hidden: [] });
  said('trying_ended', { job: 'a1', end: 'complete', message: '' });
  choosePath(1, false);
  choosePath(1, false);
  expect(useTries.getState().job?.hidden).toEqual([1]);
  choosePath(1, true);
  expect(useTries.getState().job?.hidden).toEqual([]);
});

it('does not listen to another job, and knows when its session is gone', () => {
  beginJob('a1', place, ['1']);
  said('try_outcome', outcomeOf(0, { job: 'b2' }));
  said('trying_ended', { job: 'b2', end: 'complete', message: '' });
  expect(useTries.getState().job).toMatchObject({ outcomes: [], ended: null });
  loseJob('gone');
  expect(useTries.getState().job?.ended).toEqual({ job: 'a1', end: 'failed', message: 'gone' });
});
