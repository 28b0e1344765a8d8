import type { KeyboardEvent } from 'react';
import { select, travel, type Editor, type Mode } from './editing';
import { travelOrUndoImport } from './imported';

const MODES: Readonly<Record<string, Mode>> = { m: 'move', r: 'turn', s: 'size' };

/** The step of the ghost where there is no grid. */
const SMALLEST_STEP_M = 0.01;

export type Act = (editor: Editor, event: KeyboardEvent) => void;

/** The functions that an editor provides for the keys that all editors share. */
export interface KeyActs {
  readonly modes: readonly Mode[];
  nudge(along: number, aside: number, up: number, factor: number): void;
  turn(sense: 1 | -1): void;
  remove(): void;
  duplicate(): void;
  all(): readonly string[];
  /** Additional keys that only this editor has. */
  readonly others?: Readonly<Record<string, Act>>;
}

/** Handles a key in the view, as listed in the how-to pages; the page handles other keys. */
export function onEditorKey(editor: Editor, event: KeyboardEvent, acts: KeyActs): void {
  if (event.altKey) return;
  const isControl = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const act = isControl ? withControl(key, acts) : (whilePlacing(editor, key) ?? plain(key, acts));
  if (!act) return;
  event.preventDefault();
  event.stopPropagation();
  act(editor, event);
}

type Step = readonly [number, number, number];

/** Steps ahead, to the left and up, by key. */
const STEPS: Readonly<Record<string, Step>> = {
  ArrowUp: [1, 0, 0],
  ArrowDown: [-1, 0, 0],
  ArrowLeft: [0, 1, 0],
  ArrowRight: [0, -1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};

/** Enter places the thing whose ghost is shown, and arrow keys move the ghost over the floor. */
function whilePlacing(editor: Editor, key: string): Act | undefined {
  const { placer, view, store } = editor;
  const { placing, grid } = store.getState();
  if (!placing || !placer || !view) return undefined;
  if (key === 'Enter') return (_, { shiftKey }) => placer.put(shiftKey);
  const [along, aside, up] = STEPS[key] ?? [0, 0, 1];
  if (up !== 0) return undefined;
  return (_, { shiftKey }) => {
    const size = (grid || SMALLEST_STEP_M) * (shiftKey ? 5 : 1);
    const [fx, fy] = view.forward();
    placer.shift([(fx * along - fy * aside) * size, (fy * along + fx * aside) * size]);
  };
}

function plain(key: string, acts: KeyActs): Act | undefined {
  const mode = MODES[key];
  if (mode && acts.modes.includes(mode)) return ({ store }) => store.setState({ mode });
  const step = STEPS[key];
  if (step) return (_, { shiftKey }) => acts.nudge(...step, shiftKey ? 5 : 1);
  const table: Readonly<Record<string, Act>> = {
    q: () => acts.turn(1),
    e: () => acts.turn(-1),
    Delete: () => acts.remove(),
    Backspace: () => acts.remove(),
    f: ({ store }) => store.setState({ viewpoint: { kind: 'selection' } }),
    t: ({ store }) => store.setState({ viewpoint: { kind: 'top' } }),
    p: ({ store }) => store.setState({ viewpoint: { kind: 'default' } }),
    Escape: (editor) => {
      if (editor.view?.cancel()) return;
      const { tool } = editor.store.getState();
      if (tool === 'wall') editor.store.setState({ tool: 'select' });
      else select(editor, []);
    },
    ...acts.others,
  };
  return table[key];
}

function withControl(key: string, acts: KeyActs): Act | undefined {
  const table: Readonly<Record<string, Act>> = {
    d: () => acts.duplicate(),
    a: (editor) => select(editor, acts.all()),
    z: (editor, event) => travelOrUndoImport(editor, event.shiftKey ? 'redo' : 'undo'),
    y: (editor) => travel(editor, 'redo'),
  };
  return table[key];
}

/** Handles undo and redo in the side panel, unless a text field with undo of its own has the focus. */
export function onPanelKey(editor: Editor, event: KeyboardEvent): void {
  const isTyping = event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement;
  const isControl = (event.ctrlKey || event.metaKey) && !event.altKey;
  const key = event.key.toLowerCase();
  if (isTyping || !isControl || (key !== 'z' && key !== 'y')) return;
  event.preventDefault();
  event.stopPropagation();
  travelOrUndoImport(editor, key === 'y' || event.shiftKey ? 'redo' : 'undo');
}
