import { create } from 'zustand';

/** The dialogue with the robots of the user, each of which can be ended. */
export const useOwnRobots = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openOwnRobots = () => useOwnRobots.setState({ isOpen: true });
export const closeOwnRobots = () => useOwnRobots.setState({ isOpen: false });
