import { notifications } from '@mantine/notifications';
import type * as THREE from 'three';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { putBinaries } from '@/store/saving/binary';
import { readMesh } from './scene/meshes';

export const MESH_KINDS = '.stl,.obj,.dae,.ply,.glb';

/** The largest mesh that the simulator reads, in bytes. */
const LARGEST = 50_000_000;

/** A mesh that was added to the project, with its longest side in the units of its file. */
interface Brought {
  readonly path: string;
  readonly extent: number;
}

/**
 * Adds a mesh to a folder of the project, after checking that it can be read; resolves to null if it cannot.
 */
export async function bringMesh(file: File, folder: string): Promise<Brought | null> {
  const { projectId, files } = useProjectStore.getState();
  if (!projectId) return null;
  try {
    if (file.size > LARGEST) throw new Error(t('universeEditor:tooLarge', { mb: LARGEST / 1_000_000 }));
    const data = await file.arrayBuffer();
    const extent = extentOf(await readMesh(file.name, data));
    const path = freePath(folder, file.name, new Set(Object.keys(files)));
    await putBinaries([{ path, data }]);
    return { path, extent };
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    notifications.show({
      color: 'red',
      message: t('universeEditor:meshRefused', { name: file.name, reason }),
    });
    return null;
  }
}

function extentOf(mesh: THREE.BufferGeometry): number {
  mesh.computeBoundingBox();
  const { min, max } = mesh.boundingBox ?? {};
  mesh.dispose();
  return min && max ? Math.max(max.x - min.x, max.y - min.y, max.z - min.z) : 0;
}

function freePath(folder: string, name: string, taken: ReadonlySet<string>): string {
  const clean = name.replace(/[^\w.-]/g, '_');
  const dot = clean.lastIndexOf('.');
  for (let count = 1; ; count += 1) {
    const path = `${folder}/${clean.slice(0, dot)}${count > 1 ? `_${count}` : ''}${clean.slice(dot).toLowerCase()}`;
    if (!taken.has(path)) return path;
  }
}
