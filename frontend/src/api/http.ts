import { errorFrom, offlineError } from './errors';

const BASE = '/api/v1';

interface Options {
  method?: 'GET' | 'POST' | 'PUT' | 'PATCH' | 'DELETE';
  body?: unknown;
  signal?: AbortSignal | undefined;
  /** Lets a small request finish although the page closes. */
  keepalive?: boolean;
}

async function send(path: string, { method = 'GET', body, signal, keepalive }: Options): Promise<Response> {
  const isFile = body instanceof Blob;
  const headers: Record<string, string> = { Accept: 'application/json' };
  if (body !== undefined) headers['Content-Type'] = isFile ? 'application/octet-stream' : 'application/json';
  let response: Response;
  try {
    response = await fetch(BASE + path, {
      method,
      headers,
      credentials: 'same-origin',
      ...(body === undefined ? {} : { body: isFile ? body : JSON.stringify(body) }),
      ...(signal ? { signal } : {}),
      ...(keepalive ? { keepalive } : {}),
    });
  } catch (cause) {
    if (cause instanceof DOMException && cause.name === 'AbortError') throw cause;
    throw offlineError(cause);
  }
  // The user signed out in another tab, or the sign-in has expired.
  if (response.status === 401) window.location.assign(signInPath());
  if (!response.ok) throw await errorFrom(response);
  return response;
}

function signInPath(): string {
  return `/accounts/login/?next=${encodeURIComponent(window.location.pathname)}`;
}

export async function requestJson<T>(path: string, options: Options = {}): Promise<T> {
  const response = await send(path, options);
  if (response.status === 204) return undefined as T;
  return (await response.json()) as T;
}

export async function requestText(path: string, options: Options = {}): Promise<string> {
  return (await send(path, options)).text();
}

/** The URL of a resource that the browser fetches itself, such as a download. */
export function urlOf(path: string): string {
  return BASE + path;
}

/** The URL of a socket on the page's own origin. */
export function socketUrl(path: string): string {
  const { protocol, host } = window.location;
  return `${protocol === 'https:' ? 'wss' : 'ws'}://${host}${path}`;
}
