import { create } from 'zustand';
import type { Key } from '@/model/keys/rename';

/** The dialogue that renames a key; a key of null is chosen in it. */
export const useRenameKey = create<{ isOpen: boolean; key: Key | null }>(() => ({
  isOpen: false,
  key: null,
}));

export const openRenameKey = (key: Key | null = null) => useRenameKey.setState({ isOpen: true, key });
export const closeRenameKey = () => useRenameKey.setState({ isOpen: false });
