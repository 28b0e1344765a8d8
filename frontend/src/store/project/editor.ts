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
  /** In pixels of the window: where the box opens. */
  readonly x: number;
  readonly y: number;
  readonly text: string;
}

interface EditorState {
  readonly quickAdd: QuickAdd | null;
  /** The block whose name or comment is being typed on the canvas. */
  readonly editing: { readonly node: NodeId; readonly field: 'name' | 'comment' } | null;
  /** A new block on its way from the palette. */
  readonly dragged: Kind | null;
  readonly slot: Slot | null;
  /** The block whose problems and fixes are shown. */
  readonly fixing: NodeId | null;
  /** Of each tree, the SubTrees that are looked into in place (`model/expand`). */
  readonly expanded: Readonly<Record<string, ReadonlySet<NodeId>>>;
  readonly find: boolean;
  /** null: shown for trees that are too large to be seen at once. */
  readonly minimap: boolean | null;
}

/** The transient state of the editor: nothing of it is saved or undone. */
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

/** Looks into a SubTree on the canvas of `tree`, or no longer. */
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
