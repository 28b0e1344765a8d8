import { afterEach, describe, expect, it, vi } from 'vitest';
import { api } from './client';
import { ApiError, errorFrom } from './errors';

const answer = (body: unknown, status: number, type = 'application/problem+json') =>
  new Response(typeof body === 'string' ? body : JSON.stringify(body), {
    status,
    headers: { 'content-type': type },
  });

afterEach(() => vi.unstubAllGlobals());

describe('errorFrom', () => {
  it('keeps the problem that the server sent', async () => {
    const error = await errorFrom(
      answer({ title: 'Taken', code: 'name_taken', detail: 'There is one.', hint: 'Choose another.' }, 409),
    );
    expect(error).toMatchObject({ code: 'name_taken', status: 409, message: 'There is one.' });
    expect(error.hint).toBe('Choose another.');
  });

  it('makes a problem of a body that is not problem+json', async () => {
    const error = await errorFrom(answer('<h1>Bad gateway</h1>', 502, 'text/html'));
    expect(error).toMatchObject({ status: 502, code: 'http_502' });
  });

  it('accepts JSON that is cut off', async () => {
    const error = await errorFrom(answer('{"title": "Cu', 500));
    expect(error.status).toBe(500);
  });
});

describe('api', () => {
  it('reports that the server cannot be reached', async () => {
    vi.stubGlobal('fetch', () => Promise.reject(new TypeError('Failed to fetch')));
    const error = await api.me().catch((reason: unknown) => reason);
    expect(error).toBeInstanceOf(ApiError);
    expect((error as ApiError).isOffline).toBe(true);
  });

  it('sends the base revisions and reads conflicts', async () => {
    const conflict = {
      path: 'actions/A.py',
      base_revision: 1,
      theirs: { revision: 2, content: 'theirs' },
      mine: { content: 'mine' },
    };
    const fetched = vi.fn((_request: Request) =>
      Promise.resolve(answer({ title: 'x', code: 'revision_conflict', conflicts: [conflict] }, 409)),
    );
    vi.stubGlobal('fetch', fetched);
    const files = [{ path: 'actions/A.py', base_revision: 1, content: 'mine' }];
    const error = (await api
      .saveChanges('p1', { message: 'Edit', files })
      .catch((reason: unknown) => reason)) as ApiError;
    expect(error.conflicts).toEqual([conflict]);
    const [request] = fetched.mock.calls[0]!;
    expect(new URL(request.url).pathname).toBe('/api/v1/projects/p1/changes');
    expect(await request.json()).toEqual({ message: 'Edit', files });
  });
});
