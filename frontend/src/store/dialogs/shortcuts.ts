import { create } from 'zustand';

/** Whether the list of shortcuts is open. */
export const useShortcutsDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openShortcuts = () => useShortcutsDialog.setState({ isOpen: true });
export const closeShortcuts = () => useShortcutsDialog.setState({ isOpen: false });
