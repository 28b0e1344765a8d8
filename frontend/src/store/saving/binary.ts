import { api } from '@/api/client';
import { urlOf } from '@/api/http';
import { useProjectStore } from '@/store/project';
import { mergeRemote } from '@/store/project/remote';
import { asSave, saveNow } from './autosave';

/** A binary file with its content. */
export interface Binary {
  readonly path: string;
  readonly data: ArrayBuffer;
}

/** Returns the URL of a file of the open project. */
export const fileUrl = (path: string): string => {
  const { projectId } = useProjectStore.getState();
  return urlOf(`/projects/${projectId ?? ''}/files/${path.split('/').map(encodeURIComponent).join('/')}`);
};

/** Fetches files whose content the page does not have. */
export async function fetchBinaries(paths: readonly string[]): Promise<Binary[]> {
  return Promise.all(
    paths.map(async (path) => {
      const response = await fetch(fileUrl(path), { credentials: 'same-origin' });
      if (!response.ok) throw new Error(`${path}: ${response.status}`);
      return { path, data: await response.arrayBuffer() };
    }),
  );
}

/** Adds new binary files to the project, after saving pending edits. */
export async function putBinaries(files: readonly Binary[]): Promise<void> {
  const { projectId } = useProjectStore.getState();
  if (!projectId || files.length === 0) return;
  await saveNow();
  await asSave(async () => {
    await api.saveChanges(projectId, {
      message: `Add ${files.map(({ path }) => path).join(', ')}`,
      files: files.map(({ path, data }) => ({
        path,
        base_revision: 0,
        content_base64: base64(new Uint8Array(data)),
      })),
    });
    const detail = await api.getProject(projectId);
    useProjectStore.setState((state) => mergeRemote(state, detail).data);
  });
}

function base64(bytes: Uint8Array): string {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000)
    text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}
