import { create } from 'zustand';

/** Whether the chooser is open; everybody may open it. */
export const useWorlds = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openWorlds = () => useWorlds.setState({ isOpen: true });
export const closeWorlds = () => useWorlds.setState({ isOpen: false });
