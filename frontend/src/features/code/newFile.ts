import { create } from 'zustand';

export type NewFileKind = 'action' | 'tree' | 'file';

export type FileDialog = { mode: 'new'; kind: NewFileKind } | { mode: 'rename'; path: string } | null;

export const useFileDialog = create<{ dialog: FileDialog }>(() => ({ dialog: null }));

export const openNewFile = (kind: NewFileKind) => useFileDialog.setState({ dialog: { mode: 'new', kind } });
export const openRename = (path: string) => useFileDialog.setState({ dialog: { mode: 'rename', path } });
export const closeFileDialog = () => useFileDialog.setState({ dialog: null });
