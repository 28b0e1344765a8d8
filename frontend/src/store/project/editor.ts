import { create } from 'zustand';
import type { NodeId } from '@/model/diagram';
import type { Kind, Placement } from '@/model/rules';
import type { Slot } from '@/model/slots';

/** The effect of choosing a type in the quick-add box. */
export type QuickAddGoal =
  | { readonly does: 'add'; readonly place: Placement }
  | { readonly does: 'wrap'; readonly nodes: readonly NodeId[] }
  | { readonly does: 'morph'; readonly node: NodeId };

export interface QuickAdd {
  readonly tree: string;
  readonly goal: QuickAddGoal;
  /** The position of the box, in px of the window. */
  readonly x: number;
  readonly y: number;
  readonly text: string;
}

interface EditorState {
  readonly quickAdd: QuickAdd | null;
  /** The block whose name or comment is being edited on the canvas. */
  readonly editing: { readonly node: NodeId; readonly field: 'name' | 'comment' } | null;
  /** A new block that is being dragged from the palette. */
  readonly dragged: Kind | null;
  readonly slot: Slot | null;
  /** The block whose problems and fixes are shown. */
  readonly fixing: NodeId | null;
  /** The SubTrees of each tree that are expanded in place (`model/expand`). */
  readonly expanded: Readonly<Record<string, ReadonlySet<NodeId>>>;
  readonly find: boolean;
  /** null: the minimap is shown only for trees that are too large for the view. */
  readonly minimap: boolean | null;
}

/** The transient state of the editor; it is neither saved nor undone. */
export const useEditorStore = create<EditorState>()(() => ({
  quickAdd: null,
  editing: null,
  dragged: null,
  slot: null,
  fixing: null,
  expanded: {},
  find: false,
  minimap: null,
}));

export const setEditor = useEditorStore.setState;

/** Expands or collapses a SubTree on the canvas of `tree`. */
export function toggleExpanded(tree: string, id: NodeId): void {
  setEditor(({ expanded }) => {
    const next = new Set(expanded[tree]);
    if (!next.delete(id)) next.add(id);
    return { expanded: { ...expanded, [tree]: next } };
  });
}

const LARGE = 14;

export function isMinimapShown(wish: boolean | null, blocks: number): boolean {
  return wish ?? blocks > LARGE;
}
