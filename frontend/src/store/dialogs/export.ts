import { create } from 'zustand';

/** Whether the export dialogue is open; any feature may open it. */
export const useExportDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openExportDialog = () => useExportDialog.setState({ isOpen: true });
export const closeExportDialog = () => useExportDialog.setState({ isOpen: false });
