import type { components } from '@/generated/api';
import { ApiError } from './errors';
import { dataOf, rest } from './http';
import type { ProjectDetail } from './types';

/** One change of a project, as its history tells it. */
export type Revision = Readonly<components['schemas']['Revision']>;
/** Its `diff` is null where a side is no text, or too long to be compared there. */
export type FileDifference = Readonly<components['schemas']['FileDiff']>;

const PAGE = 100;
const at = (project_id: string, number: number) => ({ path: { project_id, number } });

/** The history of a project. */
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
  /** Makes a new revision with these files, or all, as they were. */
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
  /** A file as it was; null where it was not there, or is no text. */
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
