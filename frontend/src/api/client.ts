import { requestJson, requestText, urlOf } from './http';
import type { PythonFinding } from './python';
import type {
  ActionModel,
  AppBundle,
  BehaviourInfo,
  ChangesResult,
  CheckResult,
  FileChange,
  Me,
  PackagePreview,
  ProjectDetail,
  ProjectPage,
  ProjectSettings,
  SessionInfo,
  TemplateInfo,
  UniverseInfo,
} from './types';

export type ProjectSort = 'name' | '-updated_at';
export type ProjectShelf = 'current' | 'archived' | 'deleted';

interface ProjectQuery {
  search: string;
  sort: ProjectSort;
  shelf: ProjectShelf;
  offset: number;
}

/** The number of cards that fills a large screen twice. */
const PAGE = 48;

const project = (id: string) => `/projects/${encodeURIComponent(id)}`;

/** Every call of the REST API, one function each. Each throws an `ApiError` if the server refuses. */
export const api = {
  me: () => requestJson<Me>('/me'),

  listProjects: ({ search, sort, shelf, offset }: ProjectQuery, signal?: AbortSignal) => {
    const query = new URLSearchParams({ search, sort, shelf, offset: String(offset), limit: String(PAGE) });
    return requestJson<ProjectPage>(`/projects?${query}`, { signal });
  },
  createProject: (body: { name?: string; template?: string }) =>
    requestJson<ProjectDetail>('/projects', { method: 'POST', body }),
  getProject: (id: string, signal?: AbortSignal) => requestJson<ProjectDetail>(project(id), { signal }),
  patchProject: (
    id: string,
    body: { name?: string; description?: string; settings?: Partial<ProjectSettings>; base_revision: number },
  ) => requestJson<ProjectDetail>(project(id), { method: 'PATCH', body }),
  deleteProject: (id: string) => requestJson<undefined>(project(id), { method: 'DELETE' }),
  restoreProject: (id: string) => requestJson<unknown>(`${project(id)}/restore`, { method: 'POST' }),
  archiveProject: (id: string) => requestJson<unknown>(`${project(id)}/archive`, { method: 'POST' }),
  unarchiveProject: (id: string) => requestJson<unknown>(`${project(id)}/unarchive`, { method: 'POST' }),
  duplicateProject: (id: string) =>
    requestJson<ProjectDetail>(`${project(id)}/duplicate`, { method: 'POST', body: {} }),
  // The file is the whole body, so that it may be larger than the body of any other request.
  importProject: ({ file, repair }: { file: File; repair: boolean }) => {
    const asked = new URLSearchParams({ filename: file.name, ...(repair ? { repair: 'true' } : {}) });
    return requestJson<ProjectDetail>(`/projects/import?${asked}`, { method: 'POST', body: file });
  },
  exportUrl: (id: string) => urlOf(`${project(id)}/export`),
  xmlUrl: (id: string, isSelfContained: boolean) =>
    urlOf(`${project(id)}/xml?self_contained=${String(isSelfContained)}`),
  packageUrl: (id: string, name: string) =>
    urlOf(`${project(id)}/package?${new URLSearchParams({ name }).toString()}`),
  previewPackage: (id: string, name: string, signal?: AbortSignal) =>
    requestJson<PackagePreview>(
      `${project(id)}/package/preview?${new URLSearchParams({ name }).toString()}`,
      { signal },
    ),

  saveChanges: (id: string, body: { message: string; files: FileChange[] }, keepalive = false) =>
    requestJson<ChangesResult>(`${project(id)}/changes`, { method: 'POST', body, keepalive }),
  check: (id: string, files: { path: string; content: string }[] = [], signal?: AbortSignal) =>
    requestJson<CheckResult>(`${project(id)}/check`, { method: 'POST', body: { files }, signal }),
  xml: (id: string) => requestText(`${project(id)}/xml`),
  inspectAction: (source: string, filename: string) =>
    requestJson<ActionModel>('/actions/inspect', { method: 'POST', body: { source, filename } }),

  formatPython: (source: string, filename: string) =>
    requestJson<{ source: string }>('/python/format', { method: 'POST', body: { source, filename } }),
  lintPython: async (source: string, filename: string, signal?: AbortSignal) => {
    const body = { source, filename };
    const answer = await requestJson<{ findings: PythonFinding[] }>('/python/lint', {
      method: 'POST',
      body,
      signal,
    });
    return answer.findings;
  },

  /**
   * The application in the form that the executor runs, optionally in another universe than the project's.
   */
  app: (id: string, universe?: string | null) =>
    requestJson<AppBundle>(`${project(id)}/app${universe ? `?${new URLSearchParams({ universe })}` : ''}`),
  startSession: (id: string) => requestJson<SessionInfo>(`${project(id)}/session`, { method: 'POST' }),
  getSession: (sessionId: string) => requestJson<SessionInfo>(`/sessions/${sessionId}`),
  endSession: (sessionId: string) => requestJson<undefined>(`/sessions/${sessionId}`, { method: 'DELETE' }),

  templates: () => requestItems<TemplateInfo>('/catalog/templates', 'templates'),
  behaviours: () => requestItems<BehaviourInfo>('/catalog/behaviours', 'behaviours'),
  universes: () => requestItems<UniverseInfo>('/catalog/universes', 'universes'),
  universeText: (id: string) => requestText(`/catalog/universes/${encodeURIComponent(id)}/text`),
  robotConfig: (id: string) => requestText(`/catalog/robots/${encodeURIComponent(id)}/config`),
  robotUrdf: (id: string) => requestText(`/catalog/robots/${encodeURIComponent(id)}/urdf`),
  robots: () => requestItems<UniverseInfo>('/catalog/robots', 'robots'),
};

/** The catalogue answers with a list, or with a list under `items` or under its own name. */
async function requestItems<T>(path: string, name: string): Promise<T[]> {
  const body = await requestJson<T[] | Record<string, T[]>>(path);
  return Array.isArray(body) ? body : (body['items'] ?? body[name] ?? []);
}
