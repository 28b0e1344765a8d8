import type { components } from '@/generated/api';
import { ApiError } from './errors';
import { dataOf, rest } from './http';
import type { ProjectDetail } from './types';

/** One change of a project, as its history lists it. */
export type Revision = Readonly<components['schemas']['Revision']>;
/**
 * The difference of a file between two revisions. `diff` is null if a side is not text, or too long to be
 * compared on the server.
 */
export type FileDifference = Readonly<components['schemas']['FileDiff']>;

const PAGE = 100;
const at = (project_id: string, number: number) => ({ path: { project_id, number } });

/** The calls for the history of a project. */
export const revisions = {
  list: (project_id: string, path: string, before: number | null, signal?: AbortSignal) => {
    const query = { limit: PAGE, ...(path ? { path } : {}), ...(before === null ? {} : { before }) };
    const params = { path: { project_id }, query };
    return dataOf(rest.GET('/api/v1/projects/{project_id}/revisions', { params, signal: signal ?? null }));
  },
  label: (projectId: string, number: number, label: string) =>
    dataOf(
      rest.PATCH('/api/v1/projects/{project_id}/revisions/{number}', {
        params: at(projectId, number),
        body: { label },
      }),
    ),
  /** Restores files of an old revision as a new revision: the given ones, or all. */
  restore: (projectId: string, number: number, paths: readonly string[]): Promise<ProjectDetail> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/revisions/{number}/restore', {
        params: at(projectId, number),
        body: { paths: [...paths] },
      }),
    ),
  differences: async (projectId: string, newer: number, older: number, signal?: AbortSignal) => {
    const params = { ...at(projectId, newer), query: { against: older } };
    const answer = await dataOf(
      rest.GET('/api/v1/projects/{project_id}/revisions/{number}/diff', { params, signal: signal ?? null }),
    );
    return answer.files;
  },
  /** Returns a file's text at a revision; null if the file did not exist then, or is not text. */
  text: async (project_id: string, number: number, path: string, signal?: AbortSignal) => {
    if (number === 0) return null;
    try {
      const text = await dataOf(
        rest.GET('/api/v1/projects/{project_id}/revisions/{number}/files/{path}', {
          params: { path: { project_id, number, path } },
          parseAs: 'text',
          signal: signal ?? null,
        }),
      );
      return text.includes('\u0000') ? null : text;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    }
  },
};
