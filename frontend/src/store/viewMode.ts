import { create } from 'zustand';

/** How much the page shows: what a first project needs, or everything. */
export type ViewMode = 'basic' | 'full';

const KEY = 'bts.view';

/** A browser that has arranged its panels before the choice existed continues with everything. */
const hasArranged = () => Object.keys(localStorage).some((key) => key.startsWith('bts.layout.'));

function kept(): ViewMode {
  const value = localStorage.getItem(KEY);
  if (value === 'basic' || value === 'full') return value;
  const first = hasArranged() ? 'full' : 'basic';
  localStorage.setItem(KEY, first);
  return first;
}

interface ViewModeData {
  readonly mode: ViewMode;
  /** Whether a project is shown: other pages have no switch, and show everything. */
  readonly isInProject: boolean;
}

export const useViewMode = create<ViewModeData>(() => ({ mode: kept(), isInProject: false }));

/** Returns whether the page leaves out what a first project does not need. */
export const useIsBasic = (): boolean =>
  useViewMode(({ mode, isInProject }) => isInProject && mode === 'basic');

/** Called while a project is shown; returns a function that ends it. */
export function showsProject(): () => void {
  useViewMode.setState({ isInProject: true });
  return () => useViewMode.setState({ isInProject: false });
}

export function setViewMode(mode: ViewMode): void {
  localStorage.setItem(KEY, mode);
  useViewMode.setState({ mode });
}
