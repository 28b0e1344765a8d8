import { afterEach, expect, it } from 'vitest';
import type { ServerMessage } from '@/generated/messages';
import { sourceOf } from '../../../../harness/tickSource';
import { beginSource, failSource, feedSource, loseSource, useTickSource } from './tickSource';

const said = (command: string, data: unknown) =>
  feedSource({ id: '', command, data, seq: 0, t: 0 } as ServerMessage);
const job = () => useTickSource.getState().job;

afterEach(loseSource);

it('follows a request to its answer', () => {
  beginSource('a1', 'run', 3.25);
  said('source_progress', { job: 'a1', fraction: 0.5 });
  said('tick', {});
  expect(job()).toMatchObject({ run: 'run', t: 3.25, fraction: 0.5, found: null });
  said('tick_source', sourceOf());
  said('source_progress', { job: 'a1', fraction: 0.9 });
  expect(job()).toMatchObject({ fraction: 0.5, found: { tick: 65, problem: '' } });
});

it('does not listen to an earlier request', () => {
  beginSource('b2', 'run', 3.25);
  said('tick_source', sourceOf());
  said('source_progress', { job: 'a1', fraction: 0.9 });
  expect(job()).toMatchObject({ id: 'b2', fraction: 0, found: null });
});

it('keeps why there is none', () => {
  beginSource('a1', 'run', 3.25);
  failSource('a1', 'A live run.');
  said('tick_source', sourceOf());
  expect(job()?.found).toMatchObject({ problem: 'A live run.', calls: [] });
  loseSource();
  expect(job()).toBeNull();
});
