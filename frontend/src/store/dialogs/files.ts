import { create } from 'zustand';

import type { DocumentKind } from '@/store/project/moving';

export type NewFileKind = 'action' | 'tree' | 'file';
/**
 * The kinds of documents that the name dialogue handles. New universes and robots have dialogues of their
 * own, but are renamed in this one.
 */
export type NamedKind = (NewFileKind & DocumentKind) | 'universe' | 'robot';

export type FileDialog = { mode: 'new'; kind: NewFileKind } | { mode: 'rename'; path: string } | null;

export const useFileDialog = create<{ dialog: FileDialog }>(() => ({ dialog: null }));

export const openNewFile = (kind: NewFileKind) => useFileDialog.setState({ dialog: { mode: 'new', kind } });
export const openRename = (path: string) => useFileDialog.setState({ dialog: { mode: 'rename', path } });
export const closeFileDialog = () => useFileDialog.setState({ dialog: null });
