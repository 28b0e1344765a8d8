import { LSPPlugin } from '@codemirror/lsp-client';
import { showDialog, type Command, type EditorView, type KeyBinding } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { isPythonName } from '@/model/pythonNames';
import { actionPath } from '@/store/project/state';
import { useProjectStore } from '@/store/project';
import { pathOf } from './uris';

interface TextEdit {
  readonly range: {
    readonly start: { line: number; character: number };
    readonly end: { line: number; character: number };
  };
  readonly newText: string;
}

/** Renames the symbol at the cursor in every file of the project. */
export const renameSymbol: Command = (view) => {
  const word = view.state.wordAt(view.state.selection.main.head);
  const plugin = LSPPlugin.get(view);
  if (!word || !plugin?.client.serverCapabilities) return false;
  const before = view.state.sliceDoc(word.from, word.to);
  const { close, result } = showDialog(view, {
    label: t('code:rename.label', { name: before }),
    input: { name: 'name', value: before, 'aria-label': t('code:rename.label', { name: before }) },
    submitLabel: t('code:rename.submit'),
    focus: true,
    class: 'cm-lsp-rename-panel',
  });
  void result.then((form) => {
    view.dispatch({ effects: close });
    view.focus();
    const field = form?.elements.namedItem('name');
    const after = field instanceof HTMLInputElement ? field.value.trim() : '';
    if (after !== '' && after !== before) void rename(view, word.from, before, after);
  });
  return true;
};

async function rename(view: EditorView, at: number, before: string, after: string): Promise<void> {
  const plugin = LSPPlugin.get(view);
  if (!plugin) return;
  if (!isPythonName(after)) {
    notifications.show({ color: 'red', message: t('code:rename.noName', { name: after }) });
    return;
  }
  const { client } = plugin;
  client.sync();
  try {
    await client.withMapping(async (mapping) => {
      const answer = await client.request<unknown, { changes?: Record<string, TextEdit[]> } | null>(
        'textDocument/rename',
        { newName: after, position: plugin.toPosition(at), textDocument: { uri: plugin.uri } },
      );
      const changes = Object.entries(answer?.changes ?? {});
      if (changes.length === 0) throw new Error(t('code:rename.nothing', { name: before }));
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
        before,
        after,
      );
      const count = changes.reduce((sum, [, edits]) => sum + edits.length, 0);
      notifications.show({ message: t('code:rename.done', { count, files: changes.length, name: after }) });
    });
  } catch (error) {
    notifications.show({ color: 'red', message: messageOf(error) });
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

function messageOf(error: unknown): string {
  if (error instanceof Error) return error.message;
  const { message } = (error ?? {}) as { message?: string };
  return message ?? String(error);
}

export const renameKeymap: readonly KeyBinding[] = [{ key: 'F2', run: renameSymbol, preventDefault: true }];
