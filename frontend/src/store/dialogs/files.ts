import { create } from 'zustand';

import type { DocumentKind } from '@/store/project/moving';

export type NewFileKind = 'action' | 'tree' | 'file';
/** Universes and robots are made by dialogues of their own, and renamed by this one. */
export type NamedKind = (NewFileKind & DocumentKind) | 'universe' | 'robot';

export type FileDialog = { mode: 'new'; kind: NewFileKind } | { mode: 'rename'; path: string } | null;

export const useFileDialog = create<{ dialog: FileDialog }>(() => ({ dialog: null }));

export const openNewFile = (kind: NewFileKind) => useFileDialog.setState({ dialog: { mode: 'new', kind } });
export const openRename = (path: string) => useFileDialog.setState({ dialog: { mode: 'rename', path } });
export const closeFileDialog = () => useFileDialog.setState({ dialog: null });
