import { useCallback, useRef, type ReactNode } from 'react';
import { MESH_KINDS } from '@/features/editor3d/upload';
import type { MeshFile } from '@/model/robot/bodies';
import type { RobotEditor } from './editor';
import { bringHere } from './meshes';

/** Uploads a mesh for the robot: `ask` opens the file dialogue, and the caller must render `input`. */
export function useBringMesh(
  editor: RobotEditor,
  testId: string,
  onMesh: (mesh: MeshFile) => void,
): { readonly ask: () => void; readonly input: ReactNode } {
  const ref = useRef<HTMLInputElement>(null);
  const ask = useCallback(() => ref.current?.click(), []);
  const input = (
    <input
      ref={ref}
      type="file"
      hidden
      accept={MESH_KINDS}
      data-testid={testId}
      onChange={(event) => {
        const [file] = event.currentTarget.files ?? [];
        event.currentTarget.value = '';
        if (!file) return;
        void bringHere(editor, file).then((mesh) => {
          if (mesh) onMesh(mesh);
        });
      }}
    />
  );
  return { ask, input };
}
