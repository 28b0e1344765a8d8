import { create } from 'zustand';

/** The dialogue with the kept runs of the project. */
export const useRunsDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openRunsDialog = () => useRunsDialog.setState({ isOpen: true });
export const closeRunsDialog = () => useRunsDialog.setState({ isOpen: false });
