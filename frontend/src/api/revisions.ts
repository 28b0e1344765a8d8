import { ApiError } from './errors';
import { requestJson, requestText } from './http';
import type { ProjectDetail } from './types';

export interface RevisionFile {
  readonly path: string;
  readonly change: 'written' | 'deleted' | 'renamed';
  readonly renamed_from: string;
}

/** One entry of a project's history. */
export interface Revision {
  readonly number: number;
  readonly message: string;
  readonly label: string;
  readonly author: string;
  readonly created_at: string;
  readonly files: readonly RevisionFile[];
}

export interface RevisionPage {
  readonly items: readonly Revision[];
  readonly next_before: number | null;
}

export interface FileDifference {
  readonly path: string;
  readonly change: 'added' | 'removed' | 'changed';
  /** null: one side is not text, or the texts are too long to compare on the server. */
  readonly diff: string | null;
}

const PAGE = 100;
const base = (projectId: string) => `/projects/${encodeURIComponent(projectId)}/revisions`;

/** The history of a project. */
export const revisions = {
  list: (projectId: string, path: string, before: number | null, signal?: AbortSignal) => {
    const query = new URLSearchParams({ limit: String(PAGE) });
    if (path) query.set('path', path);
    if (before !== null) query.set('before', String(before));
    return requestJson<RevisionPage>(`${base(projectId)}?${query}`, { signal });
  },
  label: (projectId: string, number: number, label: string) =>
    requestJson<Revision>(`${base(projectId)}/${number}`, { method: 'PATCH', body: { label } }),
  /** Makes a new revision in which these files, or all files, are as they were. */
  restore: (projectId: string, number: number, paths: readonly string[]) =>
    requestJson<ProjectDetail>(`${base(projectId)}/${number}/restore`, { method: 'POST', body: { paths } }),
  differences: async (projectId: string, newer: number, older: number, signal?: AbortSignal) => {
    const path = `${base(projectId)}/${newer}/diff?against=${older}`;
    return (await requestJson<{ files: FileDifference[] }>(path, { signal })).files;
  },
  /** The content of a file in a revision; null if it did not exist or is not text. */
  text: async (projectId: string, number: number, path: string, signal?: AbortSignal) => {
    if (number === 0) return null;
    const address = path.split('/').map(encodeURIComponent).join('/');
    try {
      const text = await requestText(`${base(projectId)}/${number}/files/${address}`, { signal });
      return text.includes('\u0000') ? null : text;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    }
  },
};
