import { api } from '@/api/client';
import { imports, type ImportedPart, type ImportWish, type Upload } from '@/api/imports';
import { useProjectStore } from '@/store/project';
import type { ProjectData } from '@/store/project/state';
import { mergeRemote } from '@/store/project/remote';
import { asSave, saveNow } from './autosave';

/** What an import wrote, without its report. */
export type WrittenPart = Omit<ImportedPart, 'report' | 'test_drive' | 'can_simplify' | 'things'>;

/** Loads what the server wrote into the open project. */
async function takeWritten(projectId: string): Promise<void> {
  const detail = await api.getProject(projectId);
  if (useProjectStore.getState().projectId !== projectId) return;
  useProjectStore.setState((state) => mergeRemote(state, detail).data);
}

/** Returns what was written although the import was cancelled; null for nothing. */
function writtenSince(before: ProjectData, { kind, name }: ImportWish): WrittenPart | null {
  const { files, projectId } = useProjectStore.getState();
  const path = kind === 'robot' ? `robots/${name}/robot.yaml` : `universes/${name}.yaml`;
  const folder = kind === 'robot' ? `robots/${name}/` : `assets/${name}/`;
  const revision = files[path]?.revision ?? 0;
  if (projectId !== before.projectId || revision <= before.revision) return null;
  const isOwn = (each: string) => each === path || each.startsWith(folder);
  return {
    ...{ revision, previous_revision: before.revision, path, name },
    paths: Object.keys(files).filter((each) => isOwn(each) && files[each]?.revision === revision),
    removed: Object.keys(before.files).filter((each) => isOwn(each) && !(each in files)),
  };
}

/**
 * Imports a robot or a world into the project, after saving pending edits; the server makes one revision.
 *
 * @param onLate Called with what was written although the user cancelled: the signal came too late.
 */
export async function importPart(
  projectId: string,
  upload: Upload,
  wish: ImportWish,
  signal: AbortSignal,
  onLate: (part: WrittenPart) => void,
): Promise<ImportedPart> {
  await saveNow();
  const before = useProjectStore.getState();
  let part: ImportedPart | null = null;
  try {
    await asSave(async () => {
      try {
        part = await imports.take(projectId, upload, wish, signal);
      } finally {
        // When the user cancels, the revision may just have been written. If it cannot be loaded now, the
        // page finds it with the next notice of the server.
        if (part !== null || signal.aborted) await takeWritten(projectId).catch(() => undefined);
      }
    });
  } finally {
    const late = signal.aborted ? writtenSince(before, wish) : null;
    if (late !== null) onLate(late);
  }
  signal.throwIfAborted();
  if (part === null) throw new Error('The import has no result.');
  return part;
}
