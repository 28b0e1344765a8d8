import type { ComponentType } from 'react';
import { create } from 'zustand';

export type CommandGroup = 'run' | 'edit' | 'project' | 'view' | 'canvas' | 'go' | 'rates';

/** A user command: one entry serves the toolbar, the shortcuts and the command palette. */
export interface UserCommand {
  id: string;
  group: CommandGroup;
  /** i18n key with its namespace: `frame:command.run`. */
  labelKey: string;
  /** The values that fill the label's placeholders. */
  labelValues?: Readonly<Record<string, string | number>>;
  icon?: ComponentType<{ size?: number | string }>;
  /** The shortcut in the notation of tinykeys: `$mod+KeyK`, `F5`. */
  shortcut?: string;
  /** Keys that another listener handles, in the same notation: shown, but not bound here. */
  keys?: string;
  enabled?: () => boolean;
  /** Tells the user why the command is not possible now, after its shortcut; returns whether there is anything to tell. */
  explain?: () => boolean;
  /**
   * Runs the command. `page` is the document where the user called it: a panel can be in a window of its own.
   */
  run: (page?: Document) => void;
  /**
   * The state in which the command has its shortcut before others with the same one: a debugger's keys mean
   * something else while it holds the tree, and Escape while two runs are compared. The command is enabled in
   * that state alone.
   */
  when?: 'held' | 'compared';
  /** Whether the command palette leaves it out. */
  hidden?: boolean;
  /** Whether the shortcut also works while a text field has the focus. */
  inTextFields?: boolean;
}

interface CommandTable {
  commands: Record<string, UserCommand>;
}

export const useCommandTable = create<CommandTable>(() => ({ commands: {} }));

/** Adds commands to the table; returns a function that removes them. */
export function registerCommands(rows: readonly UserCommand[]): () => void {
  useCommandTable.setState(({ commands }) => {
    const next = { ...commands };
    for (const row of rows) {
      const rival = Object.values(next).find(
        (other) =>
          row.shortcut && other.shortcut === row.shortcut && other.when === row.when && other.id !== row.id,
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

/** Runs a command, if it is available now. */
export function perform(id: string, page: Document = document): void {
  const command = useCommandTable.getState().commands[id];
  if (command && command.enabled?.() !== false) command.run(page);
}
