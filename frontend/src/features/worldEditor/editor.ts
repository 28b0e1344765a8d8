import { notifications } from '@mantine/notifications';
import { createStore, type StoreApi } from 'zustand/vanilla';
import { t } from '@/i18n';
import type { Edit } from '@/model/universe/edits';
import { record, redo, seal, startHistory, undo, type TextHistory } from '@/model/document/history';
import { readUniverse, type Reading } from '@/model/universe/read';
import { rewrite } from '@/model/document/rewrite';
import type { Point } from '@/model/document/values';
import type { Universe } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';

export type Mode = 'move' | 'turn' | 'size';
export type Tool = 'select' | 'wall';

export const GRIDS = [0, 0.05, 0.1, 0.5] as const;
export const TURN_STEP = Math.PI / 12;

/** What the view can do for the keyboard and for what is placed. */
export interface ViewHandle {
  /** The middle of what is seen of the floor. */
  center(): Point;
  /** Away from the one who looks, along the nearest axis. */
  forward(): Point;
  /** Cancels a gesture that is under way; tells whether there was one. */
  cancel(): boolean;
}

export interface EditorData {
  readonly history: TextHistory;
  readonly selection: readonly string[];
  /** The chosen point of the way of the selected person. */
  readonly waypoint: number | null;
  readonly mode: Mode;
  readonly tool: Tool;
  readonly grid: number;
  /** A new object moves the camera, also to where it already was asked to go. */
  readonly viewpoint: { readonly kind: 'default' | 'top' | 'selection' };
  readonly isTextShown: boolean;
}

/** A universe that is being edited: its steps of undo, and what is selected in it. */
export interface UniverseEditor {
  readonly path: string;
  readonly store: StoreApi<EditorData>;
  view: ViewHandle | null;
}

const known = new Map<string, UniverseEditor>();

/** The editor of a universe of the open project; it outlives its tab. */
export function editorOf(path: string): UniverseEditor {
  const { projectId, currentText } = useProjectStore.getState();
  const key = `${projectId ?? ''}:${path}`;
  let editor = known.get(key);
  if (!editor) {
    const store = createStore<EditorData>(() => ({
      history: startHistory([currentText(path) ?? '']),
      selection: [],
      waypoint: null,
      mode: 'move',
      tool: 'select',
      grid: 0.1,
      viewpoint: { kind: 'default' },
      isTextShown: false,
    }));
    editor = { path, store, view: null };
    known.set(key, editor);
  }
  return editor;
}

/** The universe as it is now, as far as it can be read. */
export const readingOf = ({ path }: UniverseEditor): Reading =>
  readUniverse(useProjectStore.getState().currentText(path) ?? '');

export const isReadOnly = (): boolean => useProjectStore.getState().role === 'viewer';

/** Tells the editor of the view that shows it, or that there is none any more. */
export function showIn(editor: UniverseEditor, view: ViewHandle | null): void {
  editor.view = view;
}

/** Notes what was typed in the text beside, or came from elsewhere, as a step like any other. */
export function followText(editor: UniverseEditor, text: string): void {
  const { history, selection } = editor.store.getState();
  const step = { label: 'text', mergeKey: 'text', before: selection, after: selection };
  const next = record(history, [text], step);
  if (next !== history) editor.store.setState({ history: next });
}

interface EditOptions {
  readonly mergeKey?: string;
}

/** Changes the universe; one step of undo, joined with the last one of the same `mergeKey`. */
export function edit(
  editor: UniverseEditor,
  label: string,
  make: (universe: Universe) => Edit,
  { mergeKey }: EditOptions = {},
): void {
  const project = useProjectStore.getState();
  const text = project.currentText(editor.path);
  const { universe } = readingOf(editor);
  if (text === null || !universe || isReadOnly()) return;
  const { ops, select } = make(universe);
  if (ops.length === 0) return;
  let written: string;
  try {
    written = rewrite(text, ops);
  } catch {
    notifications.show({ color: 'red', message: t('worldEditor:unwritable') });
    return;
  }
  followText(editor, text);
  const { history, selection } = editor.store.getState();
  const after = select ?? selection;
  const start = mergeKey === undefined ? seal(history) : history;
  const step = { label, mergeKey: mergeKey ?? null, before: selection, after };
  const isSame = after.length === selection.length && after.every((key, index) => key === selection[index]);
  editor.store.setState({
    history: record(start, [written], step),
    selection: after,
    ...(isSame ? {} : { waypoint: null }),
  });
  project.setFileText(editor.path, written);
}

export function travel(editor: UniverseEditor, direction: 'undo' | 'redo'): void {
  if (isReadOnly()) return;
  const { history } = editor.store.getState();
  const next = direction === 'undo' ? undo(history) : redo(history);
  const step = direction === 'undo' ? history.past.at(-1) : history.future[0];
  if (!next || !step) return;
  const wanted = direction === 'undo' ? step.before : step.after;
  const things = new Set(readUniverse(next.texts[0] ?? '').universe?.things.map(({ key }) => key));
  editor.store.setState({
    history: next,
    selection: wanted.filter((key) => things.has(key)),
    waypoint: null,
  });
  useProjectStore.getState().setFileText(editor.path, next.texts[0] ?? '');
}

export function select(
  editor: UniverseEditor,
  selection: readonly string[],
  waypoint: number | null = null,
): void {
  const { history } = editor.store.getState();
  editor.store.setState({ selection, waypoint, history: seal(history) });
}

/** Adds one to the selection, or takes it out. */
export function toggle(editor: UniverseEditor, key: string): void {
  const { selection } = editor.store.getState();
  select(editor, selection.includes(key) ? selection.filter((other) => other !== key) : [...selection, key]);
}
