import { create } from 'zustand';
import type { Conflict } from '@/api/types';

/** Where the user's edits are: on the server, being sent, or only here. */
export type SaveState =
  | { kind: 'saved' }
  | { kind: 'dirty' }
  | { kind: 'saving' }
  /** `code` and `reason` are the server's; the edits are kept here, so that nothing is lost. */
  | { kind: 'failed'; code: string; reason: string }
  | { kind: 'conflict'; conflicts: Conflict[] };

export interface SavingData {
  state: SaveState;
  /** The number of files whose edits were restored after a crash or reload. */
  restoredFiles: number;
}

export const useSavingStore = create<SavingData>(() => ({ state: { kind: 'saved' }, restoredFiles: 0 }));
