import type { ComponentType } from 'react';
import { create } from 'zustand';

export type ActionGroup = 'run' | 'edit' | 'project' | 'view' | 'canvas' | 'go' | 'rates';

/** Something that a user can do: the same row feeds toolbar, shortcuts and command palette. */
export interface UserAction {
  id: string;
  group: ActionGroup;
  /** i18n key with its namespace: `frame:action.run`. */
  labelKey: string;
  /** What the label is filled with. */
  labelValues?: Readonly<Record<string, string | number>>;
  icon?: ComponentType<{ size?: number | string }>;
  /** In tinykeys' words: `$mod+KeyK`, `F5`. */
  shortcut?: string;
  /** Keys that another listener has, in the same words: shown, and not bound. */
  keys?: string;
  enabled?: () => boolean;
  /** `page` is the one on which it was asked for: a panel may have a window of its own. */
  run: (page?: Document) => void;
  /** Absent from the command palette. */
  hidden?: boolean;
  /** The shortcut also works while a text field has the focus. */
  inTextFields?: boolean;
}

interface ActionTable {
  actions: Record<string, UserAction>;
}

export const useActionTable = create<ActionTable>(() => ({ actions: {} }));

/** Adds rows to the table; the returned function takes them out again. */
export function registerActions(rows: readonly UserAction[]): () => void {
  useActionTable.setState(({ actions }) => {
    const next = { ...actions };
    for (const row of rows) {
      const rival = Object.values(next).find(
        (other) => row.shortcut && other.shortcut === row.shortcut && other.id !== row.id,
      );
      if (rival) throw new Error(`${row.id} and ${rival.id} both claim ${row.shortcut}`);
      next[row.id] = row;
    }
    return { actions: next };
  });
  return () => {
    useActionTable.setState(({ actions }) => ({
      actions: Object.fromEntries(
        Object.entries(actions).filter(([id, action]) => !rows.some((r) => r.id === id && r === action)),
      ),
    }));
  };
}

/** Does what the action does, unless it may not be done now. */
export function perform(id: string, page: Document = document): void {
  const action = useActionTable.getState().actions[id];
  if (action && action.enabled?.() !== false) action.run(page);
}
