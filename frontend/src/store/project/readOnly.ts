import type { ProjectState } from './state';

type Part = Partial<ProjectState>;
type Change = Part | ((state: ProjectState) => Part);

/** Wraps the store's `set` so that it refuses edits of a read-only project. */
export function refusingViewers(set: (change: (state: ProjectState) => Part) => void) {
  return (change: Change): void => {
    set((state) => {
      const next = typeof change === 'function' ? change(state) : change;
      const isEdit = next.changeCounter !== undefined && next.changeCounter !== state.changeCounter;
      const isSameProject = next.projectId === undefined || next.projectId === state.projectId;
      if (state.role === 'viewer' && isEdit && isSameProject) return { refusedEdits: state.refusedEdits + 1 };
      return next;
    });
  };
}
