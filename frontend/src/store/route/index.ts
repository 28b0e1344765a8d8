import { create } from 'zustand';

export type Route =
  { page: 'start' } | { page: 'project'; projectId: string } | { page: 'attached'; sessionId: string };

export function routeOf(pathname: string): Route {
  const sessionId = /^\/attached\/([^/]+)\/?$/.exec(pathname)?.[1];
  if (sessionId) return { page: 'attached', sessionId: decodeURIComponent(sessionId) };
  const projectId = /^\/projects\/([^/]+)\/?$/.exec(pathname)?.[1];
  return projectId ? { page: 'project', projectId: decodeURIComponent(projectId) } : { page: 'start' };
}

export const useRoute = create<{ route: Route }>(() => ({ route: routeOf(window.location.pathname) }));

window.addEventListener('popstate', () => useRoute.setState({ route: routeOf(window.location.pathname) }));

/** Goes to a page by its path, which may have a query. */
export function navigate(path: string): void {
  window.history.pushState(null, '', path);
  useRoute.setState({ route: routeOf(window.location.pathname) });
}

/** Returns the page of a session that follows a program. */
export const attachedPath = (sessionId: string) => `/attached/${encodeURIComponent(sessionId)}`;

export const projectPath = (id: string) => `/projects/${encodeURIComponent(id)}`;
