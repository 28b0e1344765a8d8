import { create } from 'zustand';

/** Whether the settings of the project are open. */
export const useSettingsDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openSettings = () => useSettingsDialog.setState({ isOpen: true });
export const closeSettings = () => useSettingsDialog.setState({ isOpen: false });
