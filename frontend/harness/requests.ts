import { onTestFinished, vi } from 'vitest';
import type { Revision } from '@/api/revisions';
import type { Me, Problem, ProjectSummary } from '@/api/types';

/** The server's answer where there is nothing to say. */
export const noContent = () => new Response(null, { status: 204 });

/** A refusal as the server sends it. */
export const refusal = (detail: string, more: Partial<Problem> = {}) =>
  Response.json({ title: 'Refused', code: 'refused', detail, ...more }, { status: more.status ?? 400 });

/** The signed-in user of an installation with accounts. */
export const account = (more: Partial<Me> = {}): Me => ({
  mode: 'team',
  user: 'ada',
  name: 'Ada Lovelace',
  email: 'ada@example.org',
  role: 'user',
  version: '1',
  users_run_as_server: false,
  ...more,
});

/** Records where the page would go, and stays. */
export function watchLocation() {
  const assign = vi.fn<(address: string) => void>();
  const { href, origin, protocol, host, pathname, search, hash } = window.location;
  vi.stubGlobal('location', { href, origin, protocol, host, pathname, search, hash, assign });
  onTestFinished(() => {
    vi.unstubAllGlobals();
  });
  return assign;
}

/** A revision of a project; each number is a minute after the one before. */
export const revision = (number: number, more: Partial<Revision> = {}): Revision => ({
  number,
  message: 'Edit MainTree.json',
  label: '',
  author: 'ada',
  created_at: new Date(Date.UTC(2026, 0, 1, 10, number)).toISOString(),
  files: [],
  ...more,
});

/** A project as the start page lists it. */
export const summary = (id: string, more: Partial<ProjectSummary> = {}): ProjectSummary => ({
  id,
  name: `Project ${id}`,
  description: '',
  main_tree: 'MainTree',
  universe: '',
  revision: 3,
  created_at: '2026-01-01T00:00:00Z',
  updated_at: '2026-01-01T00:00:00Z',
  root_diagram: null,
  conditions: [],
  ...more,
});
