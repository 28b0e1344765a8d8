import type { ActionModel } from '@/api/types';
import type { UndoEntry } from '@/model/undo';
import { currentText, tryParse } from './files';
import { readSettings } from './settings';
import { treeIdOf, type FileEntry, type ProjectData } from './state';

/** Texts by path; null removes the file. */
type Texts = Readonly<Record<string, string | null>>;

const PROJECT_FILE = 'project.json';
const ACTION = /^actions\/([^/]+)\.py$/;

/** Returns the kind of an action that the server has not read yet, by the words that declare it. */
function kindOf(source: string): ActionModel['kind'] {
  if (/^\s*class\s+\w+\([^)]*\bControlNode\b/m.test(source)) return 'Control';
  if (/^\s*class\s+\w+\([^)]*\bDecoratorNode\b/m.test(source)) return 'Decorator';
  return /^\s*NODE_KIND\s*=\s*["']Condition["']/m.test(source) ? 'Condition' : 'Action';
}

/**
 * Returns the actions after files were added or removed; a new action accepts any port until the server has
 * read it.
 */
function actionsWith(before: ProjectData['actions'], texts: Texts): ProjectData['actions'] {
  const gone = new Set(Object.keys(texts).filter((path) => texts[path] === null));
  const left = before.filter(({ path }) => path === undefined || !gone.has(path));
  const known = new Set(left.map(({ name }) => name));
  const fresh = Object.entries(texts).flatMap(([path, text]): ActionModel[] => {
    const name = ACTION.exec(path)?.[1];
    if (name === undefined || text === null || known.has(name)) return [];
    return [{ name, path, doc: '', kind: kindOf(text), open: true, ports: [] }];
  });
  return left.length === before.length && fresh.length === 0 ? before : [...left, ...fresh];
}

function without(data: ProjectData, path: string): ProjectData {
  const { [path]: entry, ...files } = data.files;
  if (!entry) return data;
  const removed = entry.revision > 0 ? { ...data.removed, [path]: entry.revision } : data.removed;
  return { ...data, files, removed };
}

function withTextFile(data: ProjectData, path: string, text: string): ProjectData {
  const { [path]: revision = 0, ...removed } = data.removed;
  const fresh: FileEntry = { path, kind: 'text', text, revision, savedText: null };
  const entry = data.files[path];
  const next: FileEntry = entry ? { ...entry, kind: 'text', text } : fresh;
  return { ...data, files: { ...data.files, [path]: next }, removed };
}

function withTree(data: ProjectData, id: string, path: string, text: string | null): ProjectData {
  // The steps on this tree's own undo stack apply only to its former content.
  const { [id]: _history, ...histories } = data.histories;
  const { [id]: _diagram, ...diagrams } = data.diagrams;
  const bare = { ...data, histories, diagrams };
  if (text === null) return without(bare, path);
  const diagram = tryParse(id, text);
  if (!diagram) return withTextFile(bare, path, text);
  return { ...bare, diagrams: { ...diagrams, [id]: diagram } };
}

/** Returns the settings that a text of `project.json` states; none if it cannot be read. */
function settingsIn({ name, mainTree: main_tree }: ProjectData, text: string): Partial<ProjectData> {
  try {
    const settings = readSettings({ name, main_tree, settings: JSON.parse(text) as Record<string, unknown> });
    return { settings, mainTree: settings.main_tree, name: settings.name };
  } catch {
    return {};
  }
}

/** Writes and removes files, trees among them; `knowing` completes the result. */
export function withTexts(data: ProjectData, texts: Texts): ProjectData {
  let next = data;
  for (const [path, text] of Object.entries(texts)) {
    const id = treeIdOf(path);
    if (id !== null) next = withTree(next, id, path, text);
    else next = text === null ? without(next, path) : withTextFile(next, path, text);
    if (path === PROJECT_FILE && text !== null) next = { ...next, ...settingsIn(next, text) };
  }
  const actions = actionsWith(data.actions, texts);
  return actions === data.actions ? next : { ...next, actions };
}

/**
 * Reverts the file changes of a step, or makes them again. A file that was edited since the step stays as it
 * is, so that no work is lost.
 */
export function withFilesOfStep(
  data: ProjectData,
  { files = [] }: UndoEntry,
  direction: 'undo' | 'redo',
): ProjectData {
  const texts = files
    .map(({ path, before, after }) =>
      direction === 'undo' ? { path, from: after, to: before } : { path, from: before, to: after },
    )
    .filter(({ path, from }) => currentText(data, path) === from)
    .map(({ path, to }) => [path, to] as const);
  return texts.length === 0 ? data : withTexts(data, Object.fromEntries(texts));
}
