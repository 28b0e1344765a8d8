import { notifications } from '@mantine/notifications';
import { api } from '@/api/client';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { mergeRemote } from '@/store/project/remote';
import { saveNow } from '@/store/saving/autosave';
import { readMesh } from '@/features/editor3d/meshes';

export const MESH_KINDS = '.stl,.obj,.dae,.ply,.glb';

/** As large as the simulator reads them. */
const LARGEST = 50_000_000;

/** Puts a mesh into the project's assets, once it can be read; resolves to its path, or null. */
export async function bringMesh(file: File): Promise<string | null> {
  const { projectId, files } = useProjectStore.getState();
  if (!projectId) return null;
  try {
    if (file.size > LARGEST) throw new Error(t('worldEditor:tooLarge', { mb: LARGEST / 1_000_000 }));
    const data = await file.arrayBuffer();
    await readMesh(file.name, data);
    const path = freePath(file.name, new Set(Object.keys(files)));
    await saveNow();
    await api.saveChanges(projectId, {
      message: `Add ${path}`,
      files: [{ path, base_revision: 0, content_base64: base64(new Uint8Array(data)) }],
    });
    const detail = await api.getProject(projectId);
    useProjectStore.setState((state) => mergeRemote(state, detail).data);
    return path;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    notifications.show({ color: 'red', message: t('worldEditor:meshRefused', { name: file.name, reason }) });
    return null;
  }
}

function freePath(name: string, taken: ReadonlySet<string>): string {
  const clean = name.replace(/[^\w.-]/g, '_');
  const dot = clean.lastIndexOf('.');
  for (let count = 1; ; count += 1) {
    const path = `assets/${clean.slice(0, dot)}${count > 1 ? `_${count}` : ''}${clean.slice(dot).toLowerCase()}`;
    if (!taken.has(path)) return path;
  }
}

function base64(bytes: Uint8Array): string {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000)
    text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}
