import type { components } from '@/generated/api';
import { dataOf, done, rest, urlOf } from './http';

/** A run that was kept with its project. */
export type StoredRun = Readonly<components['schemas']['Run']>;
export type RunChange = Partial<Pick<StoredRun, 'name' | 'note' | 'is_pinned' | 'is_shared'>> & {
  /** Keeps the last run. */
  readonly is_last?: false;
};
/** A kept run of the user, with its project. */
export type MyRun = Readonly<components['schemas']['MyRun']>;
export interface RunToKeep {
  /** The name that its session gave it. */
  readonly run: string;
  readonly name: string;
  readonly note: string;
  /** The attached session that has it; by default that of the project. */
  readonly session?: string;
}

/** A file as the body of a call; the call names the file. */
const body = (file: File) => ({
  body: file,
  bodySerializer: (plain: unknown) => plain as File,
  headers: { 'Content-Type': 'application/octet-stream' },
});
const at = (project_id: string, run_id: string) => ({ path: { project_id, run_id } });

/** The calls for the kept runs of a project. */
export const runs = {
  list: async (project_id: string, signal?: AbortSignal): Promise<readonly StoredRun[]> => {
    const params = { path: { project_id } };
    const call = rest.GET('/api/v1/projects/{project_id}/runs', { params, signal: signal ?? null });
    return (await dataOf(call)).items;
  },
  get: (projectId: string, id: string): Promise<StoredRun> =>
    dataOf(rest.GET('/api/v1/projects/{project_id}/runs/{run_id}', { params: at(projectId, id) })),
  keep: (project_id: string, body: RunToKeep): Promise<StoredRun> =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/runs', { params: { path: { project_id } }, body })),
  addLog: (project_id: string, file: File): Promise<StoredRun> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/runs/logs', {
        params: { path: { project_id }, query: { filename: file.name } },
        ...body(file),
      }),
    ),
  mine: async (signal?: AbortSignal): Promise<readonly MyRun[]> =>
    (await dataOf(rest.GET('/api/v1/runs', { signal: signal ?? null }))).items,
  removeMine: (run_id: string) =>
    done(rest.DELETE('/api/v1/runs/{run_id}', { params: { path: { run_id } } })),
  openLog: (file: File): Promise<MyRun> =>
    dataOf(rest.POST('/api/v1/runs/logs', { params: { query: { filename: file.name } }, ...body(file) })),
  change: (projectId: string, id: string, body: RunChange): Promise<StoredRun> =>
    dataOf(rest.PATCH('/api/v1/projects/{project_id}/runs/{run_id}', { params: at(projectId, id), body })),
  remove: (projectId: string, id: string) =>
    done(rest.DELETE('/api/v1/projects/{project_id}/runs/{run_id}', { params: at(projectId, id) })),
  thumbnailUrl: (projectId: string, id: string) => urlOf(`/projects/${projectId}/runs/${id}/thumbnail`),
  recordingUrl: (projectId: string, id: string) => urlOf(`/projects/${projectId}/runs/${id}/recording`),
};
