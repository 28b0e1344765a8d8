import { enablePatches, produceWithPatches, type Draft } from 'immer';
import type { Diagram } from '@/model/diagram';
import { emptyUndo, record, type Renaming } from '@/model/undo';
import { sameFacts, treeFacts } from '@/model/treeFacts';
import { makeVocabulary, type Vocabulary } from '@/model/vocabulary';
import { catalog } from './catalog';
import { withLastDeclarations } from './declarations';
import { currentText, syncTrees } from './files';
import { actionPath, treePath, type Answer, type EditOptions, type ProjectData } from './state';
import { withTexts } from './writtenFiles';

enablePatches();

export type Diagrams = Readonly<Record<string, Diagram>>;

type Findings = Pick<ProjectData, 'diagnostics' | 'actions' | 'rosDistro'>;

export const initialData: ProjectData = {
  projectId: null,
  role: 'owner',
  refusedEdits: 0,
  name: '',
  description: '',
  settings: null,
  mainTree: '',
  revision: 0,
  files: {},
  removed: {},
  diagrams: {},
  actions: [],
  diagnostics: [],
  rosDistro: null,
  vocabulary: makeVocabulary(catalog),
  histories: {},
  activeTree: null,
  selection: [],
  revealed: null,
  changeCounter: 0,
};

function sameTrees(a: Vocabulary['trees'], b: Vocabulary['trees']): boolean {
  if (a.size !== b.size) return false;
  for (const [tree, facts] of a) {
    const other = b.get(tree);
    if (!other || !sameFacts(facts, other)) return false;
  }
  return true;
}

const lastActions = new WeakMap<Vocabulary, ProjectData['actions']>();

/** Returns the vocabulary of the current data: the same object as before if its inputs are unchanged. */
function vocabularyOf(data: ProjectData): Vocabulary {
  const trees = new Map(Object.entries(data.diagrams).map(([id, diagram]) => [id, treeFacts(diagram)]));
  const last = data.vocabulary;
  const isSame = lastActions.get(last) === data.actions && last.mainTree === data.mainTree;
  if (isSame && sameTrees(last.trees, trees)) return last;
  const vocabulary = makeVocabulary(catalog, data.actions, trees, data.mainTree);
  lastActions.set(vocabulary, data.actions);
  return vocabulary;
}

const NOT_CHECKED = 'BT0009';

/** Returns the findings after a check; if the server could not check, the earlier findings stay. */
export function findingsAfter(before: Findings, answer: Answer): Findings {
  const { checked, diagnostics, actions, ros_distro } = answer;
  const rosDistro = ros_distro ?? before.rosDistro;
  if (checked !== false)
    return { diagnostics, actions: withLastDeclarations(before.actions, actions), rosDistro };
  const earlier = before.diagnostics.filter(({ code }) => code !== NOT_CHECKED);
  return { diagnostics: [...earlier, ...diagnostics], actions: before.actions, rosDistro };
}

/** Returns the old object if the new data are equal to it, so that nothing is drawn again. */
export function confirmed<T>(before: T, now: T): T {
  return JSON.stringify(before) === JSON.stringify(now) ? before : now;
}

/** Returns the actions that the server read at a save, and those that were created in the page since then. */
export function actionsAfter(
  before: ProjectData['actions'],
  saved: ProjectData['actions'],
  files: ProjectData['files'],
): ProjectData['actions'] {
  const known = new Set(saved.map(({ name }) => name));
  const isNew = ({ name, path }: ProjectData['actions'][number]): boolean =>
    !known.has(name) && files[path ?? actionPath(name)]?.savedText === null;
  return confirmed(before, [...saved, ...before.filter(isNew)]);
}

/** Returns the data with files and vocabulary updated after a change of trees or actions. */
export function knowing<T extends ProjectData>(data: T): T {
  const { files, removed } = syncTrees(data);
  return { ...data, files, removed, vocabulary: vocabularyOf(data) };
}

/** A change of trees, written as if the trees were mutable. */
export type Change = (draft: Record<string, Draft<Diagram>>) => void;

export interface ChangeOptions {
  readonly mergeKey?: string | undefined;
  readonly select?: readonly string[] | undefined;
  readonly renamed?: Renaming;
  readonly files?: EditOptions['files'];
}

/** Changes trees as one step on a tree's undo stack. */
export function changeDiagrams(
  before: ProjectData,
  owner: string,
  label: string,
  change: Change,
  options: ChangeOptions,
): Partial<ProjectData> {
  const data = options.files ? knowing(withTexts(before, options.files)) : before;
  const files = Object.keys(options.files ?? {})
    .map((path) => ({ path, before: currentText(before, path), after: currentText(data, path) }))
    .filter((written) => written.before !== written.after);
  const [diagrams, patches, inverse] = produceWithPatches(data.diagrams, (draft) => {
    change(draft as Record<string, Draft<Diagram>>);
  });
  const diagram = diagrams[owner];
  const mine = data.activeTree === owner ? data.selection : [];
  const after = (options.select ?? mine).filter((id) => diagram !== undefined && id in diagram.nodes);
  if (patches.length === 0 && files.length === 0)
    return data.activeTree === owner ? { selection: after } : {};
  const undoStack = record(data.histories[owner] ?? emptyUndo, {
    label,
    mergeKey: options.mergeKey ?? null,
    patches,
    inverse,
    renamed: options.renamed,
    ...(files.length === 0 ? {} : { files }),
    before: mine,
    after,
  });
  const entry = data.files[treePath(owner)];
  // An edit of a tree replaces the text that could not be parsed.
  const isText = entry?.kind === 'tree' && entry.text !== null;
  const entries = isText ? { ...data.files, [treePath(owner)]: { ...entry, text: null } } : data.files;
  return {
    ...knowing({ ...data, files: entries, diagrams }),
    histories: { ...data.histories, [owner]: undoStack },
    ...(data.activeTree === owner ? { selection: after } : {}),
    changeCounter: data.changeCounter + 1,
  };
}

export function removeFile(data: ProjectData, path: string): Partial<ProjectData> {
  const { [path]: entry, ...files } = data.files;
  if (!entry) return {};
  const removed = entry.revision > 0 ? { ...data.removed, [path]: entry.revision } : data.removed;
  return { files, removed, changeCounter: data.changeCounter + 1 };
}
