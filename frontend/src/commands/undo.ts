import { create } from 'zustand';

/** What undo and redo work on while another document than a tree is in front. */
export interface UndoTarget {
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  readonly travel: (direction: 'undo' | 'redo') => void;
}

export const useUndoTarget = create<{ target: UndoTarget | null }>(() => ({ target: null }));

export const undoTarget = (): UndoTarget | null => useUndoTarget.getState().target;
