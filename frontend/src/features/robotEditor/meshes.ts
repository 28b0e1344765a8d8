import { bringMesh } from '@/features/editor3d/upload';
import type { MeshFile } from '@/model/robot/bodies';
import { FILES } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';
import { urdfPathOf, type RobotEditor } from './editor';

/** Drawing programs often count in mm; no part of a robot here is larger than this in m. */
const LARGEST_M = 3;
const MILLIMETRE = 0.001;

/** Where the URDF lies: its meshes are named from there. */
export function urdfFolder({ path }: RobotEditor): string {
  const urdf = urdfPathOf(path, useProjectStore.getState().currentText(path) ?? '') ?? path;
  return urdf.slice(0, urdf.lastIndexOf('/') + 1);
}

/** The meshes beside the URDF, as it names them. */
export function meshesOf(editor: RobotEditor, paths: readonly string[]): string[] {
  const folder = urdfFolder(editor);
  return paths
    .filter((path) => path.startsWith(folder) && FILES.mesh?.test(path))
    .map((path) => path.slice(folder.length))
    .sort((a, b) => a.localeCompare(b));
}

/** Puts a mesh beside the URDF; resolves to how the URDF names it, or to null where it cannot be used. */
export async function bringHere(editor: RobotEditor, file: File): Promise<MeshFile | null> {
  const folder = urdfFolder(editor);
  const mesh = await bringMesh(file, `${folder}meshes`);
  return mesh && { file: mesh.path.slice(folder.length), scale: mesh.extent > LARGEST_M ? MILLIMETRE : 1 };
}
