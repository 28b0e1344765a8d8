import { create } from 'zustand';
import type { Key } from '@/model/keys/rename';

/** The dialogue that renames a blackboard key; null: the user chooses the key in the dialogue. */
export const useRenameKey = create<{ isOpen: boolean; key: Key | null }>(() => ({
  isOpen: false,
  key: null,
}));

export const openRenameKey = (key: Key | null = null) => useRenameKey.setState({ isOpen: true, key });
export const closeRenameKey = () => useRenameKey.setState({ isOpen: false });
