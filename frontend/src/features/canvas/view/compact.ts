import { create } from 'zustand';

const STORED_AS = 'bts.compactTrees';

/** Whether leaves are drawn below each other; stored in this browser. */
export const useCompact = create<{ readonly isCompact: boolean }>(() => ({
  isCompact: localStorage.getItem(STORED_AS) === 'true',
}));

export function toggleCompact(): void {
  const isCompact = !useCompact.getState().isCompact;
  useCompact.setState({ isCompact });
  localStorage.setItem(STORED_AS, String(isCompact));
}
