import { create } from 'zustand';

/** The state of the chooser of universe and robot; any feature may open it. */
export const useUniverseChooser = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openUniverseChooser = () => useUniverseChooser.setState({ isOpen: true });
export const closeUniverseChooser = () => useUniverseChooser.setState({ isOpen: false });
