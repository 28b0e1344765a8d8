import createClient, { type Middleware } from 'openapi-fetch';
import type { paths } from '@/generated/api';
import { errorFrom, offlineError } from './errors';

const BASE = '/api/v1';

const judge: Middleware = {
  onError: ({ error }) => {
    const isAborted = error instanceof Error && error.name === 'AbortError';
    return isAborted ? undefined : offlineError(error);
  },
  onResponse: async ({ response }) => {
    // The session has ended, in another tab or by itself.
    if (response.status === 401) window.location.assign(signInPath());
    if (!response.ok) throw await errorFrom(response);
  },
};

/** The REST API by its generated paths. Refusals are thrown as `ApiError`. */
export const rest = createClient<paths>({
  baseUrl: window.location.origin,
  credentials: 'same-origin',
  headers: { Accept: 'application/json' },
  // Looked up at each call, so that tests can replace it.
  fetch: (request) => globalThis.fetch(request),
  pathSerializer: (template, values) =>
    template.replace(/\{(\w+)\}/g, (_, name: string) => encoded(name, String(values[name]))),
});
rest.use(judge);

/** A file's path keeps its slashes. */
const encoded = (name: string, value: string): string =>
  name === 'path' ? value.split('/').map(encodeURIComponent).join('/') : encodeURIComponent(value);

function signInPath(): string {
  return `/accounts/login/?next=${encodeURIComponent(window.location.pathname)}`;
}

/** What a call answered; the middleware has thrown its refusal already. */
export async function dataOf<Data>(
  answer: Promise<{ readonly data: Data } | { readonly error: unknown }>,
): Promise<Data> {
  const found = await answer;
  if ('error' in found) throw offlineError(found.error);
  return found.data;
}

/** For calls that answer nothing. */
export async function done(answer: Promise<unknown>): Promise<void> {
  await answer;
}

/** The address of something that the browser itself fetches, such as a download. */
export function urlOf(path: string): string {
  return BASE + path;
}

/** A socket's address on the page's own origin. */
export function socketUrl(path: string): string {
  const { protocol, host } = window.location;
  return `${protocol === 'https:' ? 'wss' : 'ws'}://${host}${path}`;
}
