import { create } from 'zustand';

export type Route = { page: 'start' } | { page: 'project'; projectId: string };

export function routeOf(pathname: string): Route {
  const projectId = /^\/projects\/([^/]+)\/?$/.exec(pathname)?.[1];
  return projectId ? { page: 'project', projectId: decodeURIComponent(projectId) } : { page: 'start' };
}

export const useRoute = create<{ route: Route }>(() => ({ route: routeOf(window.location.pathname) }));

window.addEventListener('popstate', () => useRoute.setState({ route: routeOf(window.location.pathname) }));

export function navigate(pathname: string): void {
  window.history.pushState(null, '', pathname);
  useRoute.setState({ route: routeOf(pathname) });
}

export const projectPath = (id: string) => `/projects/${encodeURIComponent(id)}`;
