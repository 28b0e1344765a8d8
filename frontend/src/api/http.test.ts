import { expect, it, vi } from 'vitest';
import { fakeServer } from '../../harness/testing';
import { api } from './client';
import { ApiError } from './errors';
import { socketUrl, urlOf } from './http';
import { revisions } from './revisions';

const asked = ({ requests }: ReturnType<typeof fakeServer>) =>
  requests.map(({ method, path }) => `${method} ${path}`);

it('keeps the slashes of a file, and encodes everything else', async () => {
  const text = new Response('print()\n');
  const server = fakeServer({ 'GET /projects/a%2Fb/revisions/3/files/actions/%C3%A1%20b.py': text });
  expect(await revisions.text('a/b', 3, 'actions/á b.py')).toBe('print()\n');
  expect(asked(server)).toEqual(['GET /projects/a%2Fb/revisions/3/files/actions/%C3%A1%20b.py']);
});

it('requests a page of projects', async () => {
  const page = { items: [], total: 0, next_offset: null };
  const path = '/projects?search=a%20b&sort=-updated_at&shelf=current&offset=48&limit=48';
  fakeServer({ [`GET ${path}`]: page });
  const query = { search: 'a b', sort: '-updated_at', shelf: 'current', offset: 48 } as const;
  expect(await api.listProjects(query)).toEqual(page);
});

it('sends a file as it is', async () => {
  const server = fakeServer({ 'POST /projects/import?filename=a%20b.zip&repair=true': { id: 'p1' } });
  const file = new File(['PK…'], 'a b.zip', { type: 'application/zip' });
  expect(await api.importProject({ file, repair: true })).toEqual({ id: 'p1' });
  expect(server.requests[0]?.body).toBe(file);
});

it('sends a save while the page is closing', async () => {
  const fetched = vi.fn((_: Request) => Promise.resolve(Response.json({ revision: 2 })));
  vi.stubGlobal('fetch', fetched);
  await api.saveChanges('p1', { message: '', files: [] }, true);
  const [request] = fetched.mock.calls[0]!;
  expect(request).toMatchObject({ keepalive: true, credentials: 'same-origin', method: 'POST' });
  expect(request.headers.get('Accept')).toBe('application/json');
  expect(request.headers.get('Content-Type')).toBe('application/json');
  vi.unstubAllGlobals();
});

it('goes to the sign-in page when the user is signed out, and still rejects', async () => {
  const problem = { title: 'Sign in', code: 'not_authenticated', status: 401 };
  fakeServer({ 'GET /me': Response.json(problem, { status: 401 }) });
  const { origin, pathname } = window.location;
  const search = '?run=0a&t=1';
  const assign = vi.fn();
  vi.stubGlobal('location', { origin, pathname, search, assign });
  await expect(api.me()).rejects.toMatchObject({ code: 'not_authenticated', status: 401 });
  expect(assign).toHaveBeenCalledWith(`/accounts/login/?next=${encodeURIComponent(pathname + search)}`);
});

it.each([409, 422, 503])('throws the problem of a refusal with %i', async (status) => {
  const problem = { title: 'No', code: 'no', detail: 'Not now.', hint: 'Later.', status };
  fakeServer({ 'DELETE /sessions/s1': Response.json(problem, { status }) });
  const error: unknown = await api.endSession('s1').catch((reason: unknown) => reason);
  expect(error).toBeInstanceOf(ApiError);
  expect(error).toMatchObject({ problem, message: 'Not now.', hint: 'Later.', isOffline: false });
});

it('resolves with nothing where the server sends no body', async () => {
  fakeServer({ 'DELETE /projects/p1': new Response(null, { status: 204 }) });
  expect(await api.deleteProject('p1')).toBeUndefined();
});

it('distinguishes an aborted request from an unreachable server', async () => {
  vi.stubGlobal('fetch', ({ signal }: Request) => Promise.reject(signal.reason as Error));
  const abort = new AbortController();
  abort.abort();
  await expect(api.getProject('p1', abort.signal)).rejects.toMatchObject({ name: 'AbortError' });
  vi.unstubAllGlobals();
});

it('returns the addresses of downloads and sockets', () => {
  expect(urlOf('/me/data')).toBe('/api/v1/me/data');
  expect(socketUrl('/ws/x')).toBe(`ws://${window.location.host}/ws/x`);
});
