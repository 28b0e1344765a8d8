import { create } from 'zustand';

/** The state of the export dialogue; any feature may open it. */
export const useExportDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openExportDialog = () => useExportDialog.setState({ isOpen: true });
export const closeExportDialog = () => useExportDialog.setState({ isOpen: false });
