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

/** The operations of a view that keys and the palette use. */
export interface ViewHandle {
  /** Returns the middle of the visible floor. */
  center(): Point;
  /** Returns the direction away from the camera, along the nearest axis. */
  forward(): Point;
  /** Cancels the current gesture; returns whether there was one. */
  cancel(): boolean;
}

/** A thing of the palette that is to be placed next. */
export interface Placing {
  /** Its name, for the user. */
  readonly name: string;
  readonly what: object;
}

type Pixel = Pick<MouseEvent, 'clientX' | 'clientY'>;

/** Operations of a view on the ghost of what is being placed. */
export interface Placer {
  /** Moves the ghost under the pointer; returns whether the pointer is over the view. */
  aim(at: Pixel): boolean;
  /** Moves the ghost by an offset in m. */
  shift(by: Point): void;
  /** Places the thing where its ghost is; the ghost stays for the next one if `isMore`. */
  put(isMore: boolean): void;
  /** Takes the keyboard's focus. */
  focus(): void;
}

export interface EditorData {
  readonly undoStack: TextUndo;
  readonly selection: readonly string[];
  /** The index of the selected waypoint on the path of the selected person. */
  readonly waypoint: number | null;
  readonly mode: Mode;
  readonly tool: Tool;
  /** Null: nothing is being placed. */
  readonly placing: Placing | null;
  /** Whether things can be placed now: not while the view in 3D is loading. */
  readonly canPlace: boolean;
  readonly grid: number;
  /** A request to move the camera; a new object moves it even to the same place. */
  readonly viewpoint: { readonly kind: 'default' | 'top' | 'selection' };
  readonly isTextShown: boolean;
  /** The index of the shown text. */
  readonly shownText: number;
}

/** A kind of document: the rules that find its files and its things. */
interface Kind {
  /** Returns the paths of all files. The first one is given, and its text can name the others. */
  readonly pathsOf: (first: string) => readonly string[];
  /** Returns the keys of the things that can be selected. */
  readonly keysOf: (texts: readonly string[]) => Iterable<string>;
  readonly grid: number;
}

/** The editor of a document in 3D: its undo stack and its selection. */
export interface Editor {
  /** The document's first file. */
  readonly path: string;
  readonly kind: Kind;
  readonly store: StoreApi<EditorData>;
  /** Whether the undo stack began with all texts: not while one of them is large and not loaded. */
  isWhole: boolean;
  view: ViewHandle | null;
  /** null: there is no 3D view, so things are placed at once. */
  placer: Placer | null;
}

const known = new Map<string, Editor>();

const keyOf = (path: string): string => `${useProjectStore.getState().projectId ?? ''}:${path}`;

/**
 * Returns the editor of a document of the open project. The editor stays when the tab of the document is
 * closed.
 */
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
      placing: null,
      canPlace: !hasWebGl(),
      grid: kind.grid,
      viewpoint: { kind: 'default' },
      isTextShown: !hasWebGl(),
      shownText: 0,
    }));
    editor = { path, kind, store, isWhole: isLoaded(path, kind), view: null, placer: null };
    known.set(key, editor);
  }
  return editor;
}

function textsAt(path: string, kind: Kind): readonly string[] {
  const { currentText } = useProjectStore.getState();
  const first = currentText(path) ?? '';
  return [first, ...kind.pathsOf(first).map((other) => currentText(other) ?? '')];
}

/** Returns whether the page has all texts of a document: none of its files is large and not loaded. */
function isLoaded(path: string, kind: Kind): boolean {
  const { currentText, files } = useProjectStore.getState();
  return [path, ...kind.pathsOf(currentText(path) ?? '')].every((each) => files[each]?.kind !== 'large');
}

/** Returns the current texts of a document. */
export const textsOf = ({ path, kind }: Editor): readonly string[] => textsAt(path, kind);

export const isReadOnly = (): boolean => useProjectStore.getState().role === 'viewer';

/** Sets the view that shows the editor's document. Null means no view, and cancels placing. */
export function showIn(editor: Editor, view: ViewHandle | null, placer: Placer | null = null): void {
  editor.view = view;
  editor.placer = placer;
  if (editor.store.getState().placing && !placer) editor.store.setState({ placing: null });
  editor.store.setState({ canPlace: placer !== null || !hasWebGl() });
}

/** Begins the undo stack with the texts as they are now. */
function begin(editor: Editor): void {
  editor.isWhole = isLoaded(editor.path, editor.kind);
  editor.store.setState({ undoStack: startUndo(textsOf(editor)), selection: [], waypoint: null });
}

/** Begins the undo stack of a document again, if it has an editor: its texts were replaced as a whole. */
export function restart(path: string): void {
  const editor = known.get(keyOf(path));
  if (editor) begin(editor);
}

/**
 * Records changes from the text editor or from elsewhere as undo steps. The arrival of a large text is none:
 * nothing can be undone up to there.
 */
export function followTexts(editor: Editor): void {
  if (!isLoaded(editor.path, editor.kind)) {
    editor.isWhole = false;
    return;
  }
  if (!editor.isWhole) {
    begin(editor);
    return;
  }
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

/**
 * Changes the document as one undo step, which is merged with the last one if that has the same `mergeKey`.
 */
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

/** Adds a thing to the selection, or removes it. */
export function toggle(editor: Editor, key: string): void {
  const { selection } = editor.store.getState();
  select(editor, selection.includes(key) ? selection.filter((other) => other !== key) : [...selection, key]);
}
