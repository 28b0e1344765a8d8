import type { Renaming } from '@/model/undo';
import { importsName, withName } from '@/model/pythonNames';
import { currentText } from '../files';
import { actionPath, type FileEntry, type ProjectData } from '../state';
import { removeFile } from '../transitions';

/** Renames an action: its file, its class, and the imports of other files; null if it cannot be renamed. */
export function withActionRenamed(data: ProjectData, { from, to }: Renaming): ProjectData | null {
  const [before, after] = [actionPath(from), actionPath(to)];
  const source = currentText(data, before);
  if (source === null || after in data.files) return null;
  const without = { ...data, ...removeFile(data, before) };
  const { [after]: revision = 0, ...removed } = without.removed;
  const files: Record<string, FileEntry> = { ...without.files };
  files[after] = { path: after, kind: 'text', text: withName(source, from, to), revision, savedText: null };
  for (const entry of Object.values(files)) {
    const { path, text } = entry;
    if (text === null || !path.endsWith('.py') || !importsName(text, from)) continue;
    files[path] = { ...entry, text: withName(text, from, to) };
  }
  const actions = data.actions.map((each) =>
    each.name === from ? { ...each, name: to, path: after } : each,
  );
  return { ...without, files, removed, actions };
}
