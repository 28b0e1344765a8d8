import { afterEach, beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import type { StoredRun } from '@/api/runs';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { fakeServer } from '../../../harness/testing';
import { followAddress, linkTo, momentOf, queryOf, shownAddress, type Missing } from './address';
import { lookNow, setEngineLink } from './looking';
import { useSource } from './source';
import { useMoment } from './store';

const KEPT = '0f6a1d2e-0000-4000-8000-000000000001';
const segment = segmentOf({ run: '0a', to_t: 9, bytes: 10 });
const stored = {
  id: KEPT,
  name: 'First',
  start_s: 1,
  length_s: 8,
  size: 10,
  recorded_as: '0a',
} as StoredRun;
const gone = Response.json({ title: 'Not found', code: 'not_found', status: 404 }, { status: 404 });

beforeEach(() => {
  setEngineLink(() => ({ post: vi.fn(), onMessage: () => undefined }));
  useProjectStore.setState({ projectId: 'p1' });
  onTestFinished(() => window.history.replaceState(null, '', '/'));
});

afterEach(() => {
  lookNow();
  useSessionStore.setState(initialSession, true);
});

function follow(query: string, answers: Record<string, unknown> = {}, joined = Promise.resolve()) {
  fakeServer(answers);
  window.history.replaceState(null, '', `/projects/p1${query}`);
  const missing: Missing[] = [];
  onTestFinished(followAddress(joined, (each) => missing.push(each)));
  return missing;
}

it('reads the moment of an address, and nothing else', () => {
  expect(momentOf('?run=0a1b2c3d4e5f&t=12.5')).toEqual({ run: '0a1b2c3d4e5f', isKept: false, t: 12.5 });
  expect(momentOf(`?run=${KEPT}`)).toEqual({ run: KEPT, isKept: true, t: null });
  expect(momentOf('?run=0a&t=')).toEqual({ run: '0a', isKept: false, t: 0 });
  for (const wrong of ['', '?t=3', '?run=../x&t=1', '?run=0a&t=-1', '?run=0a&t=NaN', `?run=${KEPT}0&t=1`])
    expect(momentOf(wrong)).toBeNull();
});

it('writes the address that it reads', () => {
  const link = linkTo('p1', { run: KEPT, t: 2.5 });
  expect(link).toBe(`${window.location.origin}/projects/p1?run=${KEPT}&t=2.500`);
  expect(momentOf(queryOf({ run: '0a', t: null }))).toEqual({ run: '0a', isKept: false, t: null });
});

it('opens a kept run at its moment, without a session, and keeps its address', async () => {
  const missing = follow(`?run=${KEPT}&t=4`, { [`GET /projects/p1/runs/${KEPT}`]: stored });
  await vi.waitFor(() => expect(useSource.getState().kept).toMatchObject({ id: KEPT, name: 'First' }));
  expect(useMoment.getState().t).toBe(4);
  expect(shownAddress()).toEqual({ run: KEPT, isKept: true, t: 4 });
  await vi.waitFor(() => expect(window.location.search).toBe(`?run=${KEPT}&t=4.000`));
  lookNow();
  await vi.waitFor(() => expect(window.location.search).toBe(''));
  expect(missing).toEqual([]);
});

it('goes to a run of the session as soon as it is there', async () => {
  follow('?run=0a&t=3', {}, new Promise(() => undefined));
  expect(useMoment.getState().t).toBeNull();
  useSessionStore.setState({ segments: [segment] });
  expect(useMoment.getState().t).toBe(3);
  expect(useSource.getState().kept).toBeNull();
  await vi.waitFor(() => expect(window.location.search).toBe('?run=0a&t=3.000'));
});

it('goes to an earlier run of the session', () => {
  useSessionStore.setState({ segments: [segment, { ...segment, run: '0c' }] });
  follow('?run=0a&t=3');
  expect(shownAddress()).toEqual({ run: '0a', isKept: false, t: 3 });
});

it('opens a run whose session has ended, if it was kept', async () => {
  follow('?run=0a&t=3', { 'GET /projects/p1/runs': { items: [stored] } });
  await vi.waitFor(() => expect(useSource.getState().kept?.id).toBe(KEPT));
  expect(useMoment.getState().t).toBe(3);
});

it.each([
  ['?run=0b&t=3', { 'GET /projects/p1/runs': { items: [stored] } }, { what: 'session' }],
  [`?run=${KEPT}&t=3`, { [`GET /projects/p1/runs/${KEPT}`]: gone }, { what: 'kept' }],
  [
    `?run=${KEPT}&t=3`,
    {
      [`GET /projects/p1/runs/${KEPT}`]: Response.json(
        { title: 'No', code: 'no', detail: 'Asleep.', status: 503 },
        { status: 503 },
      ),
    },
    { what: 'failed', reason: 'Asleep.' },
  ],
])('says what is missing: %s', async (query, answers, expected) => {
  const missing = follow(query, answers);
  await vi.waitFor(() => expect(missing).toEqual([expected]));
  expect(useMoment.getState().t).toBeNull();
});
