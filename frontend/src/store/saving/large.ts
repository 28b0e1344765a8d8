import { useEffect } from 'react';
import { create } from 'zustand';
import { errorFrom, offlineError } from '@/api/errors';
import { useProjectStore } from '@/store/project';
import type { FileEntry } from '@/store/project/state';
import { fileUrl } from './binary';

interface LargeFiles {
  /** The reason why a large file could not be loaded, by its path. */
  readonly failed: Readonly<Record<string, { readonly reason: string; readonly isOffline: boolean }>>;
}

/** The large files that could not be loaded. */
export const useLargeFiles = create<LargeFiles>()(() => ({ failed: {} }));

const loading = new Map<string, Promise<void>>();

/** Returns the large files of the project that are not loaded, in the order of their paths. */
export const largePaths = (files: Readonly<Record<string, FileEntry>>): string[] =>
  Object.values(files)
    .filter(({ kind }) => kind === 'large')
    .map(({ path }) => path)
    .sort();

/** Loads a large file; never rejects. A file that cannot be loaded stays large, and is in `failed`. */
export function loadLarge(path: string, signal?: AbortSignal): Promise<void> {
  const { projectId } = useProjectStore.getState();
  if (signal) return load(path, projectId, signal);
  const key = `${projectId ?? ''}/${path}`;
  const known = loading.get(key);
  if (known) return known;
  const work = load(path, projectId).finally(() => loading.delete(key));
  loading.set(key, work);
  return work;
}

/**
 * Fetches the newest saved text of a file, null if it is binary, with its revision.
 *
 * @throws It cannot be fetched.
 */
export async function fetchText(
  path: string,
  signal?: AbortSignal,
): Promise<{ readonly text: string | null; readonly revision: number }> {
  const response = await fetch(fileUrl(path), { credentials: 'same-origin', signal: signal ?? null }).catch(
    (error: unknown) => {
      throw signal?.aborted ? error : offlineError(error);
    },
  );
  if (!response.ok) throw await errorFrom(response);
  const text = textOf(await response.arrayBuffer());
  return { text, revision: Number(response.headers.get('x-revision')) };
}

async function load(path: string, projectId: string | null, signal?: AbortSignal): Promise<void> {
  try {
    const { text, revision } = await fetchText(path, signal);
    useProjectStore.setState((state) => {
      const entry = state.files[path];
      if (state.projectId !== projectId || entry?.kind !== 'large') return state;
      const kind = text === null ? 'binary' : 'text';
      const loaded: FileEntry = {
        path,
        kind,
        text,
        revision: revision || entry.revision,
        savedText: text,
      };
      return { files: { ...state.files, [path]: loaded } };
    });
    mark(path, null);
  } catch (error) {
    if (signal?.aborted) return;
    const isOffline = (error as { isOffline?: boolean }).isOffline === true;
    mark(path, { reason: error instanceof Error ? error.message : String(error), isOffline });
  }
}

/** Loads large files, one after the other; stops at a file that cannot be loaded, or when it is aborted. */
export async function loadAllLarge(signal: AbortSignal): Promise<void> {
  for (const path of largePaths(useProjectStore.getState().files)) {
    if (signal.aborted) return;
    await loadLarge(path, signal);
    if (path in useLargeFiles.getState().failed) return;
  }
}

/**
 * Loads those of the files that are large.
 *
 * @throws One of them cannot be loaded.
 */
export async function withTexts(paths: readonly string[]): Promise<void> {
  const { files } = useProjectStore.getState();
  const large = paths.filter((path) => files[path]?.kind === 'large');
  await Promise.all(large.map((path) => loadLarge(path)));
  const { failed } = useLargeFiles.getState();
  const path = large.find((each) => each in failed);
  if (path !== undefined) throw new Error(`${path}: ${failed[path]?.reason ?? ''}`);
}

/** Returns the large Python files. */
export const largePython = (): string[] =>
  largePaths(useProjectStore.getState().files).filter((path) => path.endsWith('.py'));

/**
 * Loads the large Python files, which a rename must reach.
 *
 * @throws One of them cannot be loaded.
 */
export const withAllPython = (): Promise<void> => withTexts(largePython());

/** Returns a file's text, which is loaded if the file is large; null while it is not there. */
export function useFileText(path: string | null): string | null {
  const text = useProjectStore((state) => (path === null ? null : state.currentText(path)));
  const isLarge = useProjectStore((state) => path !== null && state.files[path]?.kind === 'large');
  useEffect(() => {
    if (isLarge && path !== null) void loadLarge(path);
  }, [isLarge, path]);
  return text;
}

function mark(path: string, failure: LargeFiles['failed'][string] | null): void {
  useLargeFiles.setState(({ failed }) => {
    const { [path]: _, ...others } = failed;
    return { failed: failure ? { ...others, [path]: failure } : others };
  });
}

/** Returns bytes as text; null if they are not UTF-8 or contain NUL, as on the server. */
function textOf(data: ArrayBuffer): string | null {
  try {
    const text = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(data);
    return text.includes('\u0000') ? null : text;
  } catch {
    return null;
  }
}
