import { bringMesh } from '@/features/editor3d/upload';
import type { MeshFile } from '@/model/robot/bodies';
import { FILES } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';
import { urdfPathOf, type RobotEditor } from './editor';

/**
 * The largest plausible part in m: larger meshes are assumed to be in mm, which drawing programs often use.
 */
const LARGEST_M = 3;
const MILLIMETRE = 0.001;

/** Returns the folder of the URDF, to which mesh names are relative. */
export function urdfFolder({ path }: Pick<RobotEditor, 'path'>): string {
  const urdf = urdfPathOf(path, useProjectStore.getState().currentText(path) ?? '') ?? path;
  return urdf.slice(0, urdf.lastIndexOf('/') + 1);
}

/** Returns the meshes in the URDF's folder, by their names in the URDF. */
export function meshesOf(editor: RobotEditor, paths: readonly string[]): string[] {
  const folder = urdfFolder(editor);
  return paths
    .filter((path) => path.startsWith(folder) && FILES.mesh?.test(path))
    .map((path) => path.slice(folder.length))
    .sort((a, b) => a.localeCompare(b));
}

/** Adds a mesh in the URDF's folder; resolves to its name in the URDF, or to null if it cannot be used. */
export async function bringHere(editor: RobotEditor, file: File): Promise<MeshFile | null> {
  const folder = urdfFolder(editor);
  const mesh = await bringMesh(file, `${folder}meshes`);
  return mesh && { file: mesh.path.slice(folder.length), scale: mesh.extent > LARGEST_M ? MILLIMETRE : 1 };
}
