import { create } from 'zustand';

/** Whether the dialogue for a new universe is open, and its initial choice. */
export const useNewUniverse = create<{ base: string | null }>(() => ({ base: null }));

export const openNewUniverse = (base = 'walled_room') => useNewUniverse.setState({ base });
export const closeNewUniverse = () => useNewUniverse.setState({ base: null });

export const UNIVERSE_FILE = /^universes\/[^/]+\.yaml$/;
