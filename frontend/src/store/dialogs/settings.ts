import { create } from 'zustand';

/** The state of the dialogue with the project's settings. */
export const useSettingsDialog = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openSettings = () => useSettingsDialog.setState({ isOpen: true });
export const closeSettings = () => useSettingsDialog.setState({ isOpen: false });
