import { create } from 'zustand';

/** Whether the dialogue is open; everybody may open it. */
export const useExportDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openExportDialog = () => useExportDialog.setState({ isOpen: true });
export const closeExportDialog = () => useExportDialog.setState({ isOpen: false });
