import { afterEach, beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject } from '../../../harness/testing';
import { endTests, runTests, useTests } from './report';

afterEach(() => {
  vi.useRealTimers();
});

const report = { tests: [], problems: [], coverage: { share: 1, trees: {} } };

beforeEach(() => {
  useTests.setState(useTests.getInitialState(), true);
});

it('keeps the report of the open project', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId;
  const { requests } = fakeServer({ [`POST /projects/${id}/test`]: report });
  await runTests();
  expect(useTests.getState()).toEqual({
    project: id,
    report,
    turn: null,
    isRunning: false,
    withPython: [],
    refused: null,
    isEnded: false,
    asked: `${id} 0`,
  });
  expect(requests.at(-1)?.body).toEqual({ files: [] });
});

it('says why there is no report', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  fakeServer({});
  await runTests();
  expect(useTests.getState()).toMatchObject({ report: null, isRunning: false });
  expect(useTests.getState().refused).toBeTruthy();
});

it('does nothing without a project', async () => {
  await runTests();
  expect(useTests.getState().project).toBeNull();
});

it('runs the tests with Python of the project only on request', async () => {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId;
  const { requests } = fakeServer({ [`POST /projects/${id}/test-with-python`]: report });
  await runTests({ withPython: true });
  expect(useTests.getState()).toMatchObject({ report, refused: null });
  expect(requests.at(-1)?.body).toEqual({ files: [] });
});

it.each([
  [
    { position: 3, waits_for_own: false },
    { before: 2, isOwn: false },
  ],
  [
    { position: 1, waits_for_own: true },
    { before: 0, isOwn: true },
  ],
  [{ position: null, waits_for_own: false }, null],
  [new Response('{}', { status: 405 }), null],
])('asks each second what is before them: %j', async (answer, turn) => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const asked: Request[] = [];
  let end: (answer: Response) => void = () => undefined;
  vi.stubGlobal('fetch', (request: Request) => {
    if (request.method === 'POST') return new Promise<Response>((resolve) => (end = resolve));
    asked.push(request);
    return Promise.resolve(answer instanceof Response ? answer.clone() : Response.json(answer));
  });
  const running = runTests({ withPython: true });
  await vi.advanceTimersByTimeAsync(1000);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  await vi.waitFor(() => expect(useTests.getState().turn).toEqual(turn));
  expect(asked[0]?.signal.aborted).toBe(false);
  end(Response.json(report));
  await running;
  expect(asked[0]?.signal.aborted).toBe(true);
  expect(useTests.getState()).toMatchObject({ turn: null, isRunning: false });
  await vi.advanceTimersByTimeAsync(3000);
  expect(asked).toHaveLength(1);
  vi.unstubAllGlobals();
});

/** Starts tests with Python that wait until `answer` is called; DELETE is answered with `ended`. */
function waiting(ended: () => Response) {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  let answer: (response: Response) => void = () => undefined;
  const deleted = vi.fn(ended);
  const started = vi.fn();
  vi.stubGlobal('fetch', (request: Request) => {
    if (request.method === 'DELETE') return Promise.resolve(deleted());
    if (request.method !== 'POST' || !request.url.endsWith('/test-with-python'))
      return Promise.resolve(Response.json(report));
    started();
    return new Promise<Response>((resolve) => (answer = resolve));
  });
  onTestFinished(() => void vi.unstubAllGlobals());
  const run = runTests({ withPython: true });
  return { deleted, started, answer: (response: Response) => answer(response), run };
}
const refused = (status: number, code: string) =>
  Response.json({ title: 'Refused', detail: 'It is so.', code, status }, { status });

it('says that the user has ended the tests, which is no error', async () => {
  const { deleted, answer, run } = waiting(() => new Response(null, { status: 204 }));
  expect(useTests.getState().withPython).toHaveLength(1);
  await endTests();
  expect(deleted).toHaveBeenCalledTimes(1);
  answer(refused(409, 'tests_ended'));
  await run;
  expect(useTests.getState()).toMatchObject({ isEnded: true, refused: null, withPython: [] });
  const next = runTests();
  expect(useTests.getState()).toMatchObject({ isRunning: true, isEnded: false, report: null });
  await next;
  expect(useTests.getState()).toMatchObject({ isEnded: false, report });
});

it('can end tests that wait also after those that follow a save', async () => {
  const { deleted, answer, run } = waiting(() => new Response(null, { status: 204 }));
  await runTests();
  expect(useTests.getState()).toMatchObject({ isRunning: false });
  expect(useTests.getState().withPython).toHaveLength(1);
  await endTests();
  expect(deleted).toHaveBeenCalledTimes(1);
  answer(refused(409, 'tests_ended'));
  await run;
  expect(useTests.getState().withPython).toEqual([]);
});

it('asks again until the server knows the tests that the user ends', async () => {
  const unknown = [refused(404, 'no_tests'), refused(404, 'no_tests')];
  const { deleted, answer, run } = waiting(() => unknown.shift() ?? new Response(null, { status: 204 }));
  await endTests();
  expect(deleted).toHaveBeenCalledTimes(3);
  answer(refused(409, 'tests_ended'));
  await run;
  expect(useTests.getState()).toMatchObject({ isEnded: true, withPython: [] });
});

it('does not ask again for tests that have ended by themselves', async () => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  const { deleted, started, answer, run } = waiting(() => refused(404, 'no_tests'));
  const ending = endTests();
  await expect.poll(() => started.mock.calls.length).toBe(1);
  answer(Response.json(report));
  await run;
  await ending; // at once: no timer has run
  expect(deleted).toHaveBeenCalledTimes(1);
  expect(useTests.getState()).toMatchObject({ isEnded: false, report });
});

it('says why they cannot be ended', async () => {
  const { answer, run } = waiting(() => refused(503, 'busy'));
  await expect(endTests()).rejects.toThrow('It is so.');
  answer(Response.json(report));
  await run;
});
