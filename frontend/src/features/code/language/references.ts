import { LSPPlugin, type LSPClient } from '@codemirror/lsp-client';
import { Prec, type Extension } from '@codemirror/state';
import { keymap, type Command } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { create } from 'zustand';
import { groupPlaces, type PlacesInFile, type Range } from './places';
import { reasonOf } from './reason';

/** The places where a name is used, below the editor. */
export interface References {
  readonly name: string;
  readonly client: LSPClient;
  readonly groups: readonly PlacesInFile[];
  /** Increases with each search: a new list takes the keyboard focus. */
  readonly request: number;
}

export const useReferences = create<{ readonly found: References | null }>(() => ({ found: null }));

export function closeReferences(): void {
  useReferences.setState({ found: null });
}

let requests = 0;

/** Lists all places where the name at the cursor is used. */
export const findReferences: Command = (view) => {
  const word = view.state.wordAt(view.state.selection.main.head);
  const plugin = LSPPlugin.get(view);
  if (!word || !plugin?.client.serverCapabilities) return false;
  const { client, uri } = plugin;
  const name = view.state.sliceDoc(word.from, word.to);
  client.sync();
  const params = {
    textDocument: { uri },
    position: plugin.toPosition(word.from),
    context: { includeDeclaration: true },
  };
  void client
    .request<unknown, { uri: string; range: Range }[] | null>('textDocument/references', params)
    .then((places) => groupPlaces(client, places ?? []))
    .then(
      (groups) => {
        requests += 1;
        useReferences.setState({ found: { name, client, groups, request: requests } });
      },
      (error: unknown) => notifications.show({ color: 'red', message: reasonOf(error) }),
    );
  return true;
};

const leave: Command = () => {
  const isOpen = useReferences.getState().found !== null;
  closeReferences();
  return isOpen;
};

/** Escape closes the list even while the word that was gone to is selected, which Escape would only deselect. */
export const referencesKeys: Extension = [
  keymap.of([{ key: 'Shift-F12', run: findReferences, preventDefault: true }]),
  Prec.high(keymap.of([{ key: 'Escape', run: leave }])),
];
