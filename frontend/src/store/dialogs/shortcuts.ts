import { create } from 'zustand';

/** The state of the list of shortcuts. */
export const useShortcutsDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openShortcuts = () => useShortcutsDialog.setState({ isOpen: true });
export const closeShortcuts = () => useShortcutsDialog.setState({ isOpen: false });
