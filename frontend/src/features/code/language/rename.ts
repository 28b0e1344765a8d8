import { LSPPlugin } from '@codemirror/lsp-client';
import type { Command, EditorView, KeyBinding } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { create } from 'zustand';
import { t } from '@/i18n';
import { actionPath } from '@/store/project/state';
import { useProjectStore } from '@/store/project';
import { withAllPython } from '@/store/saving/large';
import { groupPlaces, type PlacesInFile, type Range } from './places';
import { reasonOf } from './reason';
import { pathOf } from './uris';

interface TextEdit {
  readonly range: Range;
  readonly newText: string;
}

type Changes = readonly (readonly [uri: string, edits: readonly TextEdit[]])[];

/** A rename that waits for its new name. */
export interface RenameRequest {
  readonly view: EditorView;
  readonly uri: string;
  /** The position of the name in the editor. */
  readonly at: number;
  readonly before: string;
  /** The places that change; null until the server has answered. */
  readonly groups: readonly PlacesInFile[] | null;
}

export const useRename = create<{ readonly request: RenameRequest | null }>(() => ({ request: null }));

export function leaveRename(): void {
  const { request } = useRename.getState();
  useRename.setState({ request: null });
  request?.view.focus();
}

/** Asks for a new name of the symbol at the cursor, and shows what changes in the project. */
export const renameSymbol: Command = (view) => {
  const word = view.state.wordAt(view.state.selection.main.head);
  const plugin = LSPPlugin.get(view);
  if (!word || !plugin?.client.serverCapabilities) return false;
  const before = view.state.sliceDoc(word.from, word.to);
  const request: RenameRequest = { view, uri: plugin.uri, at: word.from, before, groups: null };
  useRename.setState({ request });
  plugin.client.sync();
  // The places are the same for every new name, so any other name will do.
  void changesFor(request, `${before}_`)
    .then((changes) =>
      groupPlaces(
        plugin.client,
        changes.flatMap(([uri, edits]) => edits.map(({ range }) => ({ uri, range }))),
      ),
    )
    .then(
      (groups) => {
        if (useRename.getState().request === request) useRename.setState({ request: { ...request, groups } });
      },
      (error: unknown) => {
        if (useRename.getState().request === request) leaveRename();
        notifications.show({ color: 'red', message: reasonOf(error) });
      },
    );
  return true;
};

/**
 * Asks the server for the changes of a rename.
 *
 * @throws The symbol cannot be renamed, or is defined outside of the project.
 */
async function changesFor({ view, uri, at, before }: RenameRequest, after: string): Promise<Changes> {
  const plugin = LSPPlugin.get(view);
  if (!plugin) return [];
  const answer = await plugin.client.request<unknown, { changes?: Record<string, TextEdit[]> } | null>(
    'textDocument/rename',
    { newName: after, position: plugin.toPosition(at), textDocument: { uri } },
  );
  const changes = Object.entries(answer?.changes ?? {}).filter(([, edits]) => edits.length > 0);
  const isOutside = changes.some(([each]) => pathOf(each) === null);
  if (changes.length === 0 || isOutside) throw new Error(t('code:rename.nothing', { name: before }));
  return changes;
}

/** Renames a symbol in every file of the project. */
export async function rename(request: RenameRequest, after: string): Promise<void> {
  const client = LSPPlugin.get(request.view)?.client;
  if (!client) return;
  try {
    await withAllPython();
    client.sync();
    await client.withMapping(async (mapping) => {
      const changes = await changesFor(request, after);
      for (const [uri, edits] of changes) {
        if (!client.workspace.getFile(uri)) continue;
        client.workspace.updateFile(uri, {
          changes: edits.map(({ range, newText }) => ({
            from: mapping.mapPosition(uri, range.start),
            to: mapping.mapPosition(uri, range.end),
            insert: newText,
          })),
          userEvent: 'rename',
        });
      }
      renameActionToo(
        changes.map(([uri]) => uri),
        request.before,
        after,
      );
      const count = changes.reduce((sum, [, edits]) => sum + edits.length, 0);
      const where = t('code:places.summary', {
        places: t('code:places.places', { count }),
        files: t('code:places.files', { count: changes.length }),
      });
      notifications.show({ message: t('code:rename.done', { name: after, where }) });
    });
  } catch (error) {
    notifications.show({ color: 'red', message: reasonOf(error) });
  }
}

/** Renames the action's file and its blocks when its class is renamed, since all have the same name. */
function renameActionToo(uris: readonly string[], before: string, after: string): void {
  const { files, currentText, renameAction } = useProjectStore.getState();
  const path = actionPath(before);
  const touched = uris.some((uri) => pathOf(uri) === path);
  const renamed = touched && new RegExp(`^class ${after}\\b`, 'm').test(currentText(path) ?? '');
  if (!renamed || actionPath(after) in files) return;
  renameAction(before, after);
}

export const renameKeymap: readonly KeyBinding[] = [{ key: 'F2', run: renameSymbol, preventDefault: true }];
