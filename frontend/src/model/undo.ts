import { applyPatches, type Patch } from 'immer';

export interface Renaming {
  readonly from: string;
  readonly to: string;
}

/** One undoable step of one tree: a name for the menu, and how to go both ways. */
export interface HistoryEntry {
  readonly label: string;
  /** Steps with the same key in a row are one: typing in a field, dragging a block. */
  readonly mergeKey: string | null;
  readonly patches: readonly Patch[];
  readonly inverse: readonly Patch[];
  /** An action that got another name, with its file. */
  readonly renamed?: Renaming | undefined;
  /** What was selected before and after, so that undo shows where it happened. */
  readonly before: readonly string[];
  readonly after: readonly string[];
}

export interface History {
  readonly past: readonly HistoryEntry[];
  readonly future: readonly HistoryEntry[];
  /** Closed: the next entry is not merged into the last, whatever its key. */
  readonly sealed: boolean;
}

export const emptyHistory: History = { past: [], future: [], sealed: true };

const LIMIT = 500;

/** Adds a step. What could be redone is gone; the oldest steps beyond 500 are forgotten. */
export function record(history: History, entry: HistoryEntry): History {
  if (entry.patches.length === 0) return history;
  const last = history.past.at(-1);
  const merges = !history.sealed && entry.mergeKey !== null && last?.mergeKey === entry.mergeKey;
  if (last && merges) {
    const merged: HistoryEntry = {
      ...last,
      patches: [...last.patches, ...entry.patches],
      inverse: [...entry.inverse, ...last.inverse],
      after: entry.after,
    };
    return { past: [...history.past.slice(0, -1), merged], future: [], sealed: false };
  }
  return { past: [...history.past, entry].slice(-LIMIT), future: [], sealed: false };
}

/** Ends a gesture: the next step stands for itself. */
export function seal(history: History): History {
  return history.sealed ? history : { ...history, sealed: true };
}

export interface Travel<T> {
  readonly document: T;
  readonly history: History;
  readonly entry: HistoryEntry;
}

export function undo<T extends object>(document: T, history: History): Travel<T> | null {
  const entry = history.past.at(-1);
  if (!entry) return null;
  return {
    document: applyPatches(document, entry.inverse),
    history: { past: history.past.slice(0, -1), future: [entry, ...history.future], sealed: true },
    entry,
  };
}

export function redo<T extends object>(document: T, history: History): Travel<T> | null {
  const [entry, ...future] = history.future;
  if (!entry) return null;
  return {
    document: applyPatches(document, entry.patches),
    history: { past: [...history.past, entry], future, sealed: true },
    entry,
  };
}
