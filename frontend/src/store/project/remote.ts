import type { ProjectDetail } from '@/api/types';
import { carriedStack } from '@/model/operations/carry';
import { withLastDeclarations } from './declarations';
import { currentText, openFiles } from './files';
import { whileEditing } from './problems';
import { readSettings } from './settings';
import type { ProjectData } from './state';
import { knowing } from './transitions';

/** The result of merging the server's files into the page's. */
export interface Merged {
  readonly data: Partial<ProjectData>;
  readonly taken: readonly string[];
  /** Files that were changed on both sides: the next save asks the user. */
  readonly kept: readonly string[];
  /** How many steps can no longer be undone or done again: they would revert what others did. */
  readonly lost: number;
}

/**
 * Merges a revision that was saved elsewhere (in another tab, by another user). A file with unsaved edits
 * keeps its text and its old base, so that saving it becomes a conflict and neither version is lost.
 */
export function mergeRemote(data: ProjectData, detail: ProjectDetail): Merged {
  const remote = openFiles(detail.files);
  const files = { ...data.files };
  const diagrams = { ...data.diagrams };
  const histories = { ...data.histories };
  const taken: string[] = [];
  const kept: string[] = [];
  const isEdited = (path: string) => currentText(data, path) !== data.files[path]?.savedText;

  const drop = (path: string, tree: string | null) => {
    Reflect.deleteProperty(files, path);
    if (tree !== null) {
      Reflect.deleteProperty(diagrams, tree);
      Reflect.deleteProperty(histories, tree);
    }
    taken.push(path);
  };
  const treeOf = (path: string) => /^trees\/(.+)\.json$/.exec(path)?.[1] ?? null;

  for (const theirs of Object.values(remote.files)) {
    const mine = files[theirs.path];
    if (theirs.path in data.removed || (mine && mine.revision >= theirs.revision)) continue;
    if (mine && isEdited(theirs.path)) {
      if (currentText(data, theirs.path) !== theirs.savedText) {
        kept.push(theirs.path);
        continue;
      }
    }
    files[theirs.path] = theirs;
    const tree = treeOf(theirs.path);
    const diagram = tree === null ? undefined : remote.diagrams[tree];
    if (tree !== null && diagram) {
      diagrams[tree] = diagram;
    }
    taken.push(theirs.path);
  }
  for (const mine of Object.values(data.files)) {
    if (mine.path in remote.files || mine.revision === 0) continue;
    if (isEdited(mine.path)) kept.push(mine.path);
    else drop(mine.path, mine.kind === 'tree' ? treeOf(mine.path) : null);
  }
  const theirs = new Set(taken);
  let lost = 0;
  for (const [owner, undoStack] of Object.entries(theirs.size > 0 ? histories : {})) {
    const carried = carriedStack(undoStack, data.diagrams, diagrams, (path) => theirs.has(path));
    histories[owner] = carried.undoStack;
    lost += carried.lost;
  }
  const active = data.activeTree;
  const isActiveGone = active !== null && !(active in diagrams);
  const settings = readSettings(detail);
  const main = settings.main_tree;
  const next: ProjectData = {
    ...data,
    files,
    diagrams,
    histories,
    revision: Math.max(data.revision, detail.revision),
    actions: withLastDeclarations(data.actions, detail.actions),
    diagnostics: whileEditing(detail.diagnostics),
    ...(kept.includes('project.json')
      ? {}
      : { settings, mainTree: main, name: detail.name, description: detail.description }),
    activeTree: isActiveGone ? (main in diagrams ? main : (Object.keys(diagrams)[0] ?? null)) : active,
    selection: data.selection.filter((id) => active !== null && diagrams[active]?.nodes[id] !== undefined),
  };
  return { data: knowing(next), taken, kept, lost };
}
