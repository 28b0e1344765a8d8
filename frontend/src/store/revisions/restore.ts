import { produceWithPatches, type Draft } from 'immer';
import { revisions } from '@/api/revisions';
import type { ProjectDetail } from '@/api/types';
import type { Diagram } from '@/model/diagram';
import { emptyUndo, record } from '@/model/undo';
import { useProjectStore } from '@/store/project';
import { mergeRemote } from '@/store/project/remote';
import { asSave, saveNow } from '@/store/saving/autosave';

/** The result of a restore: the revision before it, and whether anything changed. */
export interface Restored {
  readonly previous: number;
  readonly isChanged: boolean;
}

/**
 * Restores files (all, if none are named) from a revision, as a new revision. Pending edits are saved first,
 * so that the history contains them.
 */
export async function restoreRevision(number: number, paths: readonly string[]): Promise<Restored> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) return { previous: 0, isChanged: false };
  await saveNow();
  const previous = useProjectStore.getState().revision;
  await asSave(async () => {
    takeRestored(await revisions.restore(projectId, number, paths));
  });
  return { previous, isChanged: useProjectStore.getState().revision !== previous };
}

/** Loads the restored files; for a tree, the change is a step on its undo stack. */
function takeRestored(detail: ProjectDetail): void {
  const state = useProjectStore.getState();
  if (state.projectId !== detail.id) return;
  const { data } = mergeRemote(state, detail);
  const histories = { ...data.histories };
  for (const [id, now] of Object.entries(data.diagrams ?? {})) {
    const before = state.diagrams[id];
    if (!before || before === now) continue;
    const [, patches, inverse] = produceWithPatches(state.diagrams, (draft) => {
      (draft as Record<string, Draft<Diagram>>)[id] = now as Draft<Diagram>;
    });
    const entry = { label: 'restore', mergeKey: null, patches, inverse, before: [], after: [] };
    histories[id] = record(state.histories[id] ?? emptyUndo, entry);
  }
  useProjectStore.setState({ ...data, histories });
}
