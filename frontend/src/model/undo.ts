import { applyPatches, type Patch } from 'immer';

export interface Renaming {
  readonly from: string;
  readonly to: string;
}

/** A file that a step wrote beside its tree: its texts before and after; null where there is no file. */
export interface WrittenFile {
  readonly path: string;
  readonly before: string | null;
  readonly after: string | null;
}

/** One undoable step of one tree: its label, and the patches in both directions. */
export interface UndoEntry {
  readonly label: string;
  /** Consecutive steps with the same key are merged, such as typing in a field or dragging a block. */
  readonly mergeKey: string | null;
  readonly patches: readonly Patch[];
  readonly inverse: readonly Patch[];
  /** An action that the step renamed, with its file. */
  readonly renamed?: Renaming | undefined;
  readonly files?: readonly WrittenFile[] | undefined;
  /** The selection before and after, so that undo shows where the change was. */
  readonly before: readonly string[];
  readonly after: readonly string[];
}

export interface UndoStack {
  readonly past: readonly UndoEntry[];
  readonly future: readonly UndoEntry[];
  /** The next entry is not merged with this one, whatever its key. */
  readonly sealed: boolean;
}

export const emptyUndo: UndoStack = { past: [], future: [], sealed: true };

const LIMIT = 500;

/** Adds a step. It clears the redo stack and drops the oldest steps beyond 500. */
export function record(undoStack: UndoStack, entry: UndoEntry): UndoStack {
  if (entry.patches.length === 0 && !entry.files?.length) return undoStack;
  const last = undoStack.past.at(-1);
  const merges = !undoStack.sealed && entry.mergeKey !== null && last?.mergeKey === entry.mergeKey;
  if (last && merges) {
    const merged: UndoEntry = {
      ...last,
      patches: [...last.patches, ...entry.patches],
      inverse: [...entry.inverse, ...last.inverse],
      after: entry.after,
    };
    return { past: [...undoStack.past.slice(0, -1), merged], future: [], sealed: false };
  }
  return { past: [...undoStack.past, entry].slice(-LIMIT), future: [], sealed: false };
}

/** Ends a gesture: the next step is not merged with the last one. */
export function seal(undoStack: UndoStack): UndoStack {
  return undoStack.sealed ? undoStack : { ...undoStack, sealed: true };
}

export interface Travel<T> {
  readonly document: T;
  readonly undoStack: UndoStack;
  readonly entry: UndoEntry;
}

export function undo<T extends object>(document: T, undoStack: UndoStack): Travel<T> | null {
  const entry = undoStack.past.at(-1);
  if (!entry) return null;
  return {
    document: applyPatches(document, entry.inverse),
    undoStack: { past: undoStack.past.slice(0, -1), future: [entry, ...undoStack.future], sealed: true },
    entry,
  };
}

export function redo<T extends object>(document: T, undoStack: UndoStack): Travel<T> | null {
  const [entry, ...future] = undoStack.future;
  if (!entry) return null;
  return {
    document: applyPatches(document, entry.patches),
    undoStack: { past: [...undoStack.past, entry], future, sealed: true },
    entry,
  };
}
