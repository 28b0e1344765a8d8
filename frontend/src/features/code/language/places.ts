import type { LSPClient } from '@codemirror/lsp-client';
import { EditorView } from '@codemirror/view';
import { textOfSource } from './sources';
import { nameOf, pathOf, sourceOf } from './uris';

export interface Range {
  readonly start: { readonly line: number; readonly character: number };
  readonly end: { readonly line: number; readonly character: number };
}

/** A place in a file; lines and columns count from 0. */
export interface Place {
  readonly uri: string;
  readonly line: number;
  readonly from: number;
  readonly to: number;
  /** The text of its line. */
  readonly text: string;
}

/** The places in one file, in the order of its lines. */
export interface PlacesInFile {
  readonly uri: string;
  readonly name: string;
  readonly isOutside: boolean;
  readonly places: readonly Place[];
}

/** Groups the places by file: those of the project first, in the order of their names. */
export async function groupPlaces(
  client: LSPClient,
  found: readonly { readonly uri: string; readonly range: Range }[],
): Promise<PlacesInFile[]> {
  const uris = [...new Set(found.map(({ uri }) => uri))];
  const groups = await Promise.all(
    uris.map(async (uri): Promise<PlacesInFile> => {
      const lines = (await textAt(client, uri)).split('\n');
      const places = found
        .filter((each) => each.uri === uri)
        .map(({ range: { start, end } }): Place => {
          const text = lines[start.line] ?? '';
          const to = end.line === start.line ? end.character : text.length;
          return { uri, line: start.line, from: start.character, to, text };
        })
        .sort((a, b) => a.line - b.line || a.from - b.from);
      return { uri, name: nameOf(uri), isOutside: pathOf(uri) === null, places };
    }),
  );
  return groups.sort((a, b) => Number(a.isOutside) - Number(b.isOutside) || a.name.localeCompare(b.name));
}

/** Returns the text of a file as the language server knows it; empty for a file that cannot be read. */
async function textAt(client: LSPClient, uri: string): Promise<string> {
  const file = client.workspace.getFile(uri);
  if (file) return file.doc.toString();
  return sourceOf(uri) === null ? '' : textOfSource(client, uri).catch(() => '');
}

export const countOf = (groups: readonly PlacesInFile[]): number =>
  groups.reduce((sum, { places }) => sum + places.length, 0);

/** Opens the file of a place, and selects it there. */
export async function openPlace(client: LSPClient, { uri, line, from, to }: Place): Promise<void> {
  const view = await client.workspace.displayFile(uri);
  if (!view) return;
  const { doc } = view.state;
  const at = doc.line(Math.min(line + 1, doc.lines));
  const [anchor, head] = [Math.min(at.from + from, at.to), Math.min(at.from + to, at.to)];
  view.dispatch({
    selection: { anchor, head },
    effects: EditorView.scrollIntoView(anchor, { y: 'center' }),
    userEvent: 'select.definition',
  });
  view.focus();
}
