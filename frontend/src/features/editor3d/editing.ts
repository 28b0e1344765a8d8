import { createStore, type StoreApi } from 'zustand/vanilla';
import { notifications } from '@mantine/notifications';
import { hasWebGl } from '@/features/viewer/webgl';
import { t } from '@/i18n';
import { record, redo, seal, startUndo, undo, type TextUndo } from '@/model/document/undo';
import type { Point } from '@/model/document/values';
import { useProjectStore } from '@/store/project';

export type Mode = 'move' | 'turn' | 'size';
export type Tool = 'select' | 'wall';

export const TURN_STEP = Math.PI / 12;

/** What the view can do for the keyboard and for what is placed. */
export interface ViewHandle {
  /** The middle of what is seen of the floor. */
  center(): Point;
  /** Away from the camera, along the nearest axis. */
  forward(): Point;
  /** Cancels a gesture under way; returns whether there was one. */
  cancel(): boolean;
}

export interface EditorData {
  readonly undoStack: TextUndo;
  readonly selection: readonly string[];
  /** The chosen point of the way of the selected person. */
  readonly waypoint: number | null;
  readonly mode: Mode;
  readonly tool: Tool;
  readonly grid: number;
  /** A new object moves the camera, also to where it already was asked to go. */
  readonly viewpoint: { readonly kind: 'default' | 'top' | 'selection' };
  readonly isTextShown: boolean;
  /** Which of the texts is shown: 0 is the first. */
  readonly shownText: number;
}

/** How a document of one or several files is found again after a step of undo. */
interface Kind {
  /** The files that texts belong to; the first is always the same, what it says may name the others. */
  readonly pathsOf: (first: string) => readonly string[];
  /** Keys of what can be selected. */
  readonly keysOf: (texts: readonly string[]) => Iterable<string>;
  readonly grid: number;
}

/** A document that is being edited in 3D: its steps of undo, and what is selected in it. */
export interface Editor {
  /** The document's first file. */
  readonly path: string;
  readonly kind: Kind;
  readonly store: StoreApi<EditorData>;
  view: ViewHandle | null;
}

const known = new Map<string, Editor>();

const keyOf = (path: string): string => `${useProjectStore.getState().projectId ?? ''}:${path}`;

/** The editor of a document of the open project; it outlives its tab. */
export function editorFor(path: string, kind: Kind): Editor {
  const key = keyOf(path);
  let editor = known.get(key);
  if (!editor) {
    const store = createStore<EditorData>(() => ({
      undoStack: startUndo(textsAt(path, kind)),
      selection: [],
      waypoint: null,
      mode: 'move',
      tool: 'select',
      grid: kind.grid,
      viewpoint: { kind: 'default' },
      isTextShown: !hasWebGl(),
      shownText: 0,
    }));
    editor = { path, kind, store, view: null };
    known.set(key, editor);
  }
  return editor;
}

function textsAt(path: string, kind: Kind): readonly string[] {
  const { currentText } = useProjectStore.getState();
  const first = currentText(path) ?? '';
  return [first, ...kind.pathsOf(first).map((other) => currentText(other) ?? '')];
}

/** The texts as they are now. */
export const textsOf = ({ path, kind }: Editor): readonly string[] => textsAt(path, kind);

export const isReadOnly = (): boolean => useProjectStore.getState().role === 'viewer';

/** Tells the editor of the view that shows it, or that there is none any more. */
export function showIn(editor: Editor, view: ViewHandle | null): void {
  editor.view = view;
}

/** Notes what was typed in the text beside, or came from elsewhere, as a step like any other. */
export function followTexts(editor: Editor): void {
  const { undoStack, selection } = editor.store.getState();
  const step = { label: 'text', mergeKey: 'text', before: selection, after: selection };
  const next = record(undoStack, textsOf(editor), step);
  if (next !== undoStack) editor.store.setState({ undoStack: next });
}

/** The result of an edit. */
interface Change {
  readonly texts: readonly string[];
  readonly select?: readonly string[] | undefined;
}

/** Changes the document; one step of undo, joined with the last one of the same `mergeKey`. */
export function change(editor: Editor, label: string, make: () => Change | null, mergeKey?: string): void {
  if (isReadOnly()) return;
  let made: Change | null;
  try {
    made = make();
  } catch {
    notifications.show({ color: 'red', message: t('editor3d:unwritable') });
    return;
  }
  if (!made) return;
  followTexts(editor);
  const { undoStack, selection } = editor.store.getState();
  const after = made.select ?? selection;
  const start = mergeKey === undefined ? seal(undoStack) : undoStack;
  const step = { label, mergeKey: mergeKey ?? null, before: selection, after };
  const isSame = after.length === selection.length && after.every((key, index) => key === selection[index]);
  editor.store.setState({
    undoStack: record(start, made.texts, step),
    selection: after,
    ...(isSame ? {} : { waypoint: null }),
  });
  write(editor, made.texts);
}

function write({ path, kind }: Editor, texts: readonly string[]): void {
  const [first = ''] = texts;
  [path, ...kind.pathsOf(first)].forEach((file, index) => {
    const project = useProjectStore.getState();
    const text = texts[index];
    if (text !== undefined && project.currentText(file) !== null) project.setFileText(file, text);
  });
}

export function travel(editor: Editor, direction: 'undo' | 'redo'): void {
  if (isReadOnly()) return;
  const { undoStack } = editor.store.getState();
  const next = direction === 'undo' ? undo(undoStack) : redo(undoStack);
  const step = direction === 'undo' ? undoStack.past.at(-1) : undoStack.future[0];
  if (!next || !step) return;
  const wanted = direction === 'undo' ? step.before : step.after;
  const keys = new Set(editor.kind.keysOf(next.texts));
  editor.store.setState({
    undoStack: next,
    selection: wanted.filter((key) => keys.has(key)),
    waypoint: null,
  });
  write(editor, next.texts);
}

export function select(editor: Editor, selection: readonly string[], waypoint: number | null = null): void {
  const { undoStack } = editor.store.getState();
  editor.store.setState({ selection, waypoint, undoStack: seal(undoStack) });
}

/** Adds one to the selection, or takes it out. */
export function toggle(editor: Editor, key: string): void {
  const { selection } = editor.store.getState();
  select(editor, selection.includes(key) ? selection.filter((other) => other !== key) : [...selection, key]);
}
