import { create } from 'zustand';
import type { Conflict } from '@/api/types';

/** Where the user's edits are: on the server, on their way, or only here. */
export type SaveState =
  | { kind: 'saved' }
  | { kind: 'dirty' }
  | { kind: 'saving' }
  /** `code` and `reason` as the server said them; nothing is lost, the edits are kept here. */
  | { kind: 'failed'; code: string; reason: string }
  | { kind: 'conflict'; conflicts: Conflict[] };

export interface SavingData {
  state: SaveState;
  /** When edits that a crash or reload had cut off came back, how many files they were in. */
  restoredFiles: number;
}

export const useSavingStore = create<SavingData>(() => ({ state: { kind: 'saved' }, restoredFiles: 0 }));
