import type { KeyboardEvent } from 'react';
import { deleteSelected, duplicateSelected, nudge, turnSelected } from './commands';
import { readingOf, select, travel, TURN_STEP, type Mode, type UniverseEditor } from './editor';

const MODES: Readonly<Record<string, Mode>> = { m: 'move', r: 'turn', s: 'size' };

type Act = (editor: UniverseEditor, event: KeyboardEvent) => void;

const far = (event: KeyboardEvent): number => (event.shiftKey ? 5 : 1);

/** Keys of the view, as `docs/how-to/make-a-universe.md` lists them. */
const PLAIN: Readonly<Record<string, Act>> = {
  ArrowUp: (editor, event) => nudge(editor, 1, 0, 0, far(event)),
  ArrowDown: (editor, event) => nudge(editor, -1, 0, 0, far(event)),
  ArrowLeft: (editor, event) => nudge(editor, 0, 1, 0, far(event)),
  ArrowRight: (editor, event) => nudge(editor, 0, -1, 0, far(event)),
  PageUp: (editor, event) => nudge(editor, 0, 0, 1, far(event)),
  PageDown: (editor, event) => nudge(editor, 0, 0, -1, far(event)),
  q: (editor) => turnSelected(editor, TURN_STEP),
  e: (editor) => turnSelected(editor, -TURN_STEP),
  Delete: deleteSelected,
  Backspace: deleteSelected,
  f: ({ store }) => store.setState({ viewpoint: { kind: 'selection' } }),
  t: ({ store }) => store.setState({ viewpoint: { kind: 'top' } }),
  p: ({ store }) => store.setState({ viewpoint: { kind: 'default' } }),
  w: ({ store }) => store.setState(({ tool }) => ({ tool: tool === 'wall' ? 'select' : 'wall' })),
  Escape: (editor) => {
    if (editor.view?.cancel()) return;
    const { tool } = editor.store.getState();
    if (tool === 'wall') editor.store.setState({ tool: 'select' });
    else select(editor, []);
  },
};

const WITH_CONTROL: Readonly<Record<string, Act>> = {
  d: duplicateSelected,
  a: (editor) => select(editor, readingOf(editor).universe?.things.map(({ key }) => key) ?? []),
  z: (editor, event) => travel(editor, event.shiftKey ? 'redo' : 'undo'),
  y: (editor) => travel(editor, 'redo'),
};

/** What a key does in the view; others go on to the page. */
export function onEditorKey(editor: UniverseEditor, event: KeyboardEvent): void {
  if (event.altKey) return;
  const isControl = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const mode = isControl ? undefined : MODES[key];
  const act = mode ? () => editor.store.setState({ mode }) : (isControl ? WITH_CONTROL : PLAIN)[key];
  if (!act) return;
  event.preventDefault();
  event.stopPropagation();
  act(editor, event);
}

/** Undo and redo of the side panel, but for what is being typed in its fields. */
export function onPanelKey(editor: UniverseEditor, event: KeyboardEvent): void {
  const isTyping = event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement;
  const isControl = (event.ctrlKey || event.metaKey) && !event.altKey;
  if (isTyping || !isControl || !['z', 'y'].includes(event.key.toLowerCase())) return;
  event.preventDefault();
  event.stopPropagation();
  WITH_CONTROL[event.key.toLowerCase()]?.(editor, event);
}
