import { create } from 'zustand';
import type { Conflict } from '@/api/types';

/** The state of the user's edits: on the server, being sent, or only in this page. */
export type SaveState =
  | { kind: 'saved' }
  | { kind: 'dirty' }
  | { kind: 'saving' }
  /** `code` and `reason` come from the server. The edits stay in the page, so nothing is lost. */
  | { kind: 'failed'; code: string; reason: string }
  | { kind: 'conflict'; conflicts: Conflict[] };

export interface SavingData {
  state: SaveState;
  /** The number of files whose edits were restored after a crash or reload. */
  restoredFiles: number;
  /** The number of texts on the page that are not in the project: typed to the half, or refused. */
  unsaved: number;
}

export const useSavingStore = create<SavingData>(() => ({
  state: { kind: 'saved' },
  restoredFiles: 0,
  unsaved: 0,
}));
