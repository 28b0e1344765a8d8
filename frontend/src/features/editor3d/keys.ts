import type { KeyboardEvent } from 'react';
import { select, travel, type Editor, type Mode } from './editing';

const MODES: Readonly<Record<string, Mode>> = { m: 'move', r: 'turn', s: 'size' };

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
  const act = isControl ? withControl(key, acts) : plain(key, acts);
  if (!act) return;
  event.preventDefault();
  event.stopPropagation();
  act(editor, event);
}

function plain(key: string, acts: KeyActs): Act | undefined {
  const mode = MODES[key];
  if (mode && acts.modes.includes(mode)) return ({ store }) => store.setState({ mode });
  const moves: Readonly<Record<string, readonly [number, number, number]>> = {
    ArrowUp: [1, 0, 0],
    ArrowDown: [-1, 0, 0],
    ArrowLeft: [0, 1, 0],
    ArrowRight: [0, -1, 0],
    PageUp: [0, 0, 1],
    PageDown: [0, 0, -1],
  };
  const step = moves[key];
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
    z: (editor, event) => travel(editor, event.shiftKey ? 'redo' : 'undo'),
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
  travel(editor, key === 'y' || event.shiftKey ? 'redo' : 'undo');
}
