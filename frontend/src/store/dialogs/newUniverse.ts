import { create } from 'zustand';

/** The state of the dialogue for a new universe: the initial choice while it is open, otherwise null. */
export const useNewUniverse = create<{ base: string | null }>(() => ({ base: null }));

export const openNewUniverse = (base = 'walled_room') => useNewUniverse.setState({ base });
export const closeNewUniverse = () => useNewUniverse.setState({ base: null });

export const UNIVERSE_FILE = /^universes\/[^/]+\.yaml$/;
