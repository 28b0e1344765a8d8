import { edit } from '@/model/edits';
import { applyChanges, type RenamePlan } from '@/model/keys/rename';
import { useProjectStore } from '../index';

/** Renames a key in all trees, in one undo step of the active tree; returns a function that reverts it. */
export function renameKey(plan: RenamePlan): (() => void) | null {
  const { activeTree, diagrams, apply, role } = useProjectStore.getState();
  const trees = [...new Set(plan.changes.map(({ tree }) => tree))];
  const owner = activeTree ?? trees[0];
  if (owner === undefined || plan.refusal !== null || role === 'viewer') return null;
  const also = Object.fromEntries(
    trees.flatMap((tree) => {
      const diagram = tree === owner ? undefined : diagrams[tree];
      return diagram ? [[tree, edit(diagram, ...applyChanges(tree, plan)).diagram]] : [];
    }),
  );
  apply(owner, 'renameKey', applyChanges(owner, plan), { also });
  const after = useProjectStore.getState().diagrams;
  return () => {
    if (useProjectStore.getState().diagrams === after) useProjectStore.getState().undo(owner);
  };
}
