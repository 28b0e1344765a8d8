import type { Conflict, ProjectDetail } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { saveNow } from './autosave';
import { clearDraft, readDraft } from './drafts';
import { useSavingStore } from './store';

/**
 * Ends a conflict with the text that the user chose: the server's, the user's, or a merge of both. The text
 * becomes an edit on top of the server's version, so that the history contains both.
 */
export async function resolveConflict(conflict: Conflict, text: string | null): Promise<void> {
  takeAsBase(conflict);
  const { setFileText, deleteFile } = useProjectStore.getState();
  if (text === null) deleteFile(conflict.path);
  else setFileText(conflict.path, text);

  const { state } = useSavingStore.getState();
  const left =
    state.kind === 'conflict' ? state.conflicts.filter((other) => other.path !== conflict.path) : [];
  if (left.length > 0) return useSavingStore.setState({ state: { kind: 'conflict', conflicts: left } });
  useSavingStore.setState({ state: { kind: 'dirty' } });
  await saveNow();
}

/** Makes the server's version the base of the file's edits; the file may be deleted on either side. */
function takeAsBase({ path, theirs, mine }: Conflict): void {
  const { files, addFile, rebase } = useProjectStore.getState();
  if (!(path in files)) addFile(path, theirs?.content ?? mine.content ?? '');
  // A version that is gone or not loaded is no empty text: an empty one of the user must still be sent.
  rebase(path, theirs?.revision ?? 0, theirs?.content ?? null);
}

/**
 * Restores edits that a crash or a reload interrupted. If a file has changed on the server since then, its
 * edits become a conflict.
 */
export function restoreDraft(detail: ProjectDetail): void {
  const draft = readDraft(detail.id);
  if (!draft) return;
  const { setFileText, addFile } = useProjectStore.getState();
  const conflicts: Conflict[] = [];
  let restored = 0;
  for (const change of draft.files) {
    const file = detail.files.find(({ path }) => path === change.path);
    if (change.content === undefined || file?.content === change.content) continue;
    if (file && file.revision !== change.base_revision) {
      conflicts.push({
        path: change.path,
        base_revision: change.base_revision,
        theirs: { revision: file.revision, content: file.content },
        mine: { content: change.content },
      });
      continue;
    }
    if (file) setFileText(change.path, change.content);
    else addFile(change.path, change.content);
    restored += 1;
  }
  if (restored === 0 && conflicts.length === 0) clearDraft(detail.id);
  useSavingStore.setState({ restoredFiles: restored });
  if (conflicts.length > 0) useSavingStore.setState({ state: { kind: 'conflict', conflicts } });
}
