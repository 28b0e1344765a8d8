import { useMemo } from 'react';
import type { NodeId } from '@/model/diagram';
import { treeDifference, type ChangeKind, type TreeDifference } from '@/model/difference/changes';
import { usePastTree } from '@/store/moment/pastTree';
import type { RecordedTree } from '@/store/moment/recordedTrees';
import { useProjectStore } from '@/store/project';
import { presentOf, sidesOf } from './presentTree';

/** What changed in the project since a tree ran. */
export interface ChangedSince {
  readonly difference: TreeDifference;
  /** The changed blocks by their ids in the tree that ran. */
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
  /** The present name of the tree; null if it is gone. */
  readonly name: string | null;
  readonly isRenamed: boolean;
  readonly isAttached: boolean;
}

/** Returns what changed since a tree ran; null while the user does not compare. */
export function useSince(recorded: RecordedTree, ids: readonly string[]): ChangedSince | null {
  const isCompared = usePastTree((state) => state.isCompared);
  const present = useProjectStore((state) => state.diagrams);
  return useMemo(
    () => (isCompared ? changedSince(recorded, ids, present) : null),
    [isCompared, recorded, ids, present],
  );
}

export function changedSince(
  recorded: RecordedTree,
  ids: readonly string[],
  present: Parameters<typeof presentOf>[2],
): ChangedSince {
  const { diagram: ran, isAttached } = recorded;
  const now = presentOf(ran, ids, present);
  const difference = treeDifference(...sidesOf(recorded, now));
  const marks = new Map<NodeId, ChangeKind>();
  for (const id of Object.keys(ran.nodes)) {
    const change = difference.changes.get(difference.pairs.get(id) ?? id);
    if (change) marks.set(id, change.kind);
  }
  return {
    difference,
    marks,
    name: now?.id ?? null,
    isRenamed: now !== null && now.id !== ran.id,
    isAttached,
  };
}
