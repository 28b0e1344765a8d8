import { create } from 'zustand';

/** The steps that undo and redo act on while a document other than a tree is in front. */
export interface UndoTarget {
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  readonly travel: (direction: 'undo' | 'redo') => void;
}

export const useUndoTarget = create<{ target: UndoTarget | null }>(() => ({ target: null }));

export const undoTarget = (): UndoTarget | null => useUndoTarget.getState().target;
