import type { ChangesResult, FileChange, ProjectFile } from '@/api/types';
import type { Diagram } from '@/model/diagram';
import { parseDiagram, serializeDiagram } from '@/model/serialize';
import { treePath, treeIdOf, type FileEntry, type ProjectData } from './state';

type Files = Readonly<Record<string, FileEntry>>;

export interface OpenedFiles {
  readonly files: Files;
  readonly diagrams: Readonly<Record<string, Diagram>>;
}

/** Returns a diagram; null if the text is invalid: then the user can repair the text. */
export function tryParse(id: string, text: string): Diagram | null {
  try {
    return { ...parseDiagram(text), id };
  } catch {
    return null;
  }
}

/** Separates a project's files into trees and other files. */
export function openFiles(list: readonly ProjectFile[]): OpenedFiles {
  const files: Record<string, FileEntry> = {};
  const diagrams: Record<string, Diagram> = {};
  for (const { path, revision, content, left_out: isLeftOut } of list) {
    const id = treeIdOf(path);
    const diagram = id !== null && content !== null ? tryParse(id, content) : null;
    if (id !== null && diagram) {
      diagrams[id] = diagram;
      files[path] = { path, kind: 'tree', text: null, revision, savedText: serializeDiagram(diagram) };
    } else {
      const kind = isLeftOut ? 'large' : content === null ? 'binary' : 'text';
      files[path] = { path, kind, text: content, revision, savedText: content };
    }
  }
  return { files, diagrams };
}

const serialized = new WeakMap<Diagram, string>();

function textOf(diagram: Diagram): string {
  const known = serialized.get(diagram);
  if (known !== undefined) return known;
  const text = serializeDiagram(diagram);
  serialized.set(diagram, text);
  return text;
}

export function currentText(data: ProjectData, path: string): string | null {
  const entry = data.files[path];
  if (!entry) return null;
  if (entry.text !== null || entry.kind !== 'tree') return entry.text;
  const diagram = data.diagrams[treeIdOf(path) ?? ''];
  return diagram ? textOf(diagram) : null;
}

/** Updates the list of files after trees were edited or deleted, or such a step was undone. */
export function syncTrees(data: ProjectData): Pick<ProjectData, 'files' | 'removed'> {
  const isInStep =
    Object.keys(data.diagrams).every((id) => data.files[treePath(id)]?.kind === 'tree') &&
    Object.values(data.files).every(
      ({ kind, path }) => kind !== 'tree' || data.diagrams[treeIdOf(path) ?? ''],
    );
  if (isInStep) return data;
  const files: Record<string, FileEntry> = { ...data.files };
  const removed: Record<string, number> = { ...data.removed };
  for (const id of Object.keys(data.diagrams)) {
    const path = treePath(id);
    const entry = files[path];
    if (entry?.kind === 'tree') continue;
    files[path] = {
      path,
      kind: 'tree',
      text: null,
      revision: entry?.revision ?? removed[path] ?? 0,
      savedText: null,
    };
    delete removed[path];
  }
  for (const entry of Object.values(data.files)) {
    if (entry.kind !== 'tree' || data.diagrams[treeIdOf(entry.path) ?? '']) continue;
    delete files[entry.path];
    if (entry.revision > 0) removed[entry.path] = entry.revision;
  }
  return { files, removed };
}

export function pendingChanges(data: ProjectData): FileChange[] {
  const changes: FileChange[] = [];
  for (const { path, revision, savedText } of Object.values(data.files)) {
    const content = currentText(data, path);
    if (content !== null && content !== savedText) changes.push({ path, base_revision: revision, content });
  }
  for (const [path, revision] of Object.entries(data.removed)) {
    changes.push({ path, base_revision: revision, delete: true });
  }
  return changes;
}

/** Updates the base revisions after a save; edits made since the request stay pending. */
export function applySaved(
  data: ProjectData,
  sent: readonly FileChange[],
  result: ChangesResult,
): Pick<ProjectData, 'files' | 'removed'> {
  const files: Record<string, FileEntry> = { ...data.files };
  const removed: Record<string, number> = { ...data.removed };
  const revisions = new Map(result.files.map((file) => [file.path, file.revision]));
  for (const change of sent) {
    if (change.delete) {
      delete removed[change.path];
      const revived = files[change.path];
      if (revived) files[change.path] = { ...revived, revision: 0, savedText: null };
      continue;
    }
    const revision = revisions.get(change.path) ?? result.revision;
    const entry = files[change.path];
    if (entry) files[change.path] = { ...entry, revision, savedText: change.content ?? null };
    else removed[change.path] = revision;
  }
  return { files, removed };
}
