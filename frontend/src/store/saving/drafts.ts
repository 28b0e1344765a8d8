import type { FileChange } from '@/api/types';

/** Edits that the server has not confirmed yet; they are stored in the browser until it does. */
export interface Draft {
  savedAt: number;
  files: FileChange[];
}

const key = (projectId: string) => `bts.draft.${projectId}`;

export function writeDraft(projectId: string, files: FileChange[], now = Date.now()): void {
  if (files.length === 0) return clearDraft(projectId);
  try {
    localStorage.setItem(key(projectId), JSON.stringify({ savedAt: now, files } satisfies Draft));
  } catch {
    // The browser's storage is full: unsaved edits are then lost if the page crashes.
  }
}

export function readDraft(projectId: string): Draft | null {
  const text = localStorage.getItem(key(projectId));
  if (!text) return null;
  try {
    const draft = JSON.parse(text) as Draft;
    return Array.isArray(draft.files) ? draft : null;
  } catch {
    return null;
  }
}

export function clearDraft(projectId: string): void {
  localStorage.removeItem(key(projectId));
}
