import { planInsertion, type Choice, type Insertion, type Sources } from '@/model/reuse';
import { useProjectStore } from './index';
import { actionPath, treePath } from './state';

/** Files from elsewhere that are to become part of the project. */
export interface Delivery {
  /** The paths that are used where the user inserts. */
  readonly needs: readonly string[];
  readonly sources: Sources;
}

/** Returns whether the file is the tree that the user inserts into: it can neither be replaced nor contain itself. */
export const isInsertedInto = (path: string): boolean => {
  const { activeTree } = useProjectStore.getState();
  return activeTree !== null && path === treePath(activeTree);
};

/** Plans how to bring files to the open project. */
export function planHere(
  { needs, sources }: Delivery,
  choices: Readonly<Record<string, Choice>> = {},
): Insertion {
  const { currentText, diagrams, files, vocabulary } = useProjectStore.getState();
  return planInsertion({
    needs,
    sources,
    // The tree that the user inserts into counts as different from every tree, so that an incoming one of
    // this name is renamed.
    existing: (path) => (isInsertedInto(path) ? '' : currentText(path)),
    isTaken: (name) =>
      name in diagrams || vocabulary.specs.has(name) || treePath(name) in files || actionPath(name) in files,
    choices: Object.fromEntries(Object.entries(choices).filter(([path]) => !isInsertedInto(path))),
  });
}
