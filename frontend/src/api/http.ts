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
    // The user is signed out: in another tab, or because the sign-in expired.
    if (response.status === 401) window.location.assign(signInPath());
    if (!response.ok) throw await errorFrom(response);
  },
};

/** The REST API by its generated paths. It throws refusals as `ApiError`. */
export const rest = createClient<paths>({
  baseUrl: window.location.origin,
  credentials: 'same-origin',
  headers: { Accept: 'application/json' },
  // The function is looked up at each call, so that tests can replace it.
  fetch: (request) => globalThis.fetch(request),
  pathSerializer: (template, values) =>
    template.replace(/\{(\w+)\}/g, (_, name: string) => encoded(name, String(values[name]))),
});
rest.use(judge);

/** Encodes a parameter of a path; a file's path keeps its slashes. */
const encoded = (name: string, value: string): string =>
  name === 'path' ? value.split('/').map(encodeURIComponent).join('/') : encodeURIComponent(value);

function signInPath(): string {
  return `/accounts/login/?next=${encodeURIComponent(window.location.pathname + window.location.search)}`;
}

/** Returns the body of an answer; the middleware has already thrown a refusal. */
export async function dataOf<Data>(
  answer: Promise<{ readonly data: Data } | { readonly error: unknown }>,
): Promise<Data> {
  const found = await answer;
  if ('error' in found) throw offlineError(found.error);
  return found.data;
}

/** Waits for a call whose answer has no body. */
export async function done(answer: Promise<unknown>): Promise<void> {
  await answer;
}

/** Returns the address of something that the browser itself fetches, such as a download. */
export function urlOf(path: string): string {
  return BASE + path;
}

/** Returns a socket's address on the page's own origin. */
export function socketUrl(path: string): string {
  const { protocol, host } = window.location;
  return `${protocol === 'https:' ? 'wss' : 'ws'}://${host}${path}`;
}
