import { create } from 'zustand';

interface UniverseChooser {
  readonly isOpen: boolean;
  /** The list of cards that gets the focus first. */
  readonly first: 'universe' | 'robot';
}

/** Whether the chooser of universe and robot is open; any feature may open it. */
export const useUniverseChooser = create<UniverseChooser>(() => ({ isOpen: false, first: 'universe' }));

export const openUniverseChooser = () => useUniverseChooser.setState({ isOpen: true, first: 'universe' });
export const openRobotChooser = () => useUniverseChooser.setState({ isOpen: true, first: 'robot' });
export const closeUniverseChooser = () => useUniverseChooser.setState({ isOpen: false });
