import type { Diagram } from '@/model/diagram';
import type { UndoEntry } from '@/model/undo';
import { specOf } from '@/model/vocabulary';
import type { useProjectStore } from '@/store/project';

type ProjectState = ReturnType<typeof useProjectStore.getState>;

const blocksOf = (diagrams: Readonly<Record<string, Diagram>>): number =>
  Object.values(diagrams).reduce((sum, { nodes }) => sum + Object.keys(nodes).length, 0);

/**
 * Returns the edit that this user made between two states; null if there was none, or if an edit was undone.
 */
function editBetween(now: ProjectState, before: ProjectState): UndoEntry | null {
  for (const [tree, { past }] of Object.entries(now.histories)) {
    const newest = past.at(-1);
    const earlier = before.histories[tree]?.past ?? [];
    if (newest && newest !== earlier.at(-1) && past.length >= earlier.length) return newest;
  }
  return null;
}

/** Returns whether this user added a block between two states. */
export function hasAddedBlock(now: ProjectState, before: ProjectState): boolean {
  return editBetween(now, before) !== null && blocksOf(now.diagrams) > blocksOf(before.diagrams);
}

/** Returns the next need of the selected block: values for its ports, or blocks below it. */
export function needOf({ diagrams, activeTree, selection, vocabulary }: ProjectState): 'port' | 'child' {
  const node = diagrams[activeTree ?? '']?.nodes[selection[0] ?? ''];
  const ports = node ? (specOf(vocabulary, node)?.ports ?? []) : [];
  return ports.length > 0 || node?.ports !== undefined ? 'port' : 'child';
}

const FILLS: ReadonlySet<string> = new Set(['port', 'condition', 'connect']);
const GROWS: ReadonlySet<string> = new Set(['add', 'move', 'paste', 'wrap']);

/** Returns whether this user set a port or connected blocks between two states. */
export function hasFilled(now: ProjectState, before: ProjectState): boolean {
  const edit = editBetween(now, before);
  if (!edit) return false;
  return FILLS.has(edit.label) || (needOf(before) === 'child' && GROWS.has(edit.label));
}
