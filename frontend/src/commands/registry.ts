import type { ComponentType } from 'react';
import { create } from 'zustand';

export type CommandGroup = 'run' | 'edit' | 'project' | 'view' | 'canvas' | 'go' | 'rates';

/** Something that a user can do: the same row feeds toolbar, shortcuts and command palette. */
export interface UserCommand {
  id: string;
  group: CommandGroup;
  /** i18n key with its namespace: `frame:command.run`. */
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

interface CommandTable {
  commands: Record<string, UserCommand>;
}

export const useCommandTable = create<CommandTable>(() => ({ commands: {} }));

/** Adds rows to the table; the returned function takes them out again. */
export function registerCommands(rows: readonly UserCommand[]): () => void {
  useCommandTable.setState(({ commands }) => {
    const next = { ...commands };
    for (const row of rows) {
      const rival = Object.values(next).find(
        (other) => row.shortcut && other.shortcut === row.shortcut && other.id !== row.id,
      );
      if (rival) throw new Error(`${row.id} and ${rival.id} both claim ${row.shortcut}`);
      next[row.id] = row;
    }
    return { commands: next };
  });
  return () => {
    useCommandTable.setState(({ commands }) => ({
      commands: Object.fromEntries(
        Object.entries(commands).filter(([id, command]) => !rows.some((r) => r.id === id && r === command)),
      ),
    }));
  };
}

/** Does what the command does, unless it may not be done now. */
export function perform(id: string, page: Document = document): void {
  const command = useCommandTable.getState().commands[id];
  if (command && command.enabled?.() !== false) command.run(page);
}
