import type { KeyActs } from '@/features/editor3d/keys';
import { TURN_STEP } from '@/features/editor3d/editing';
import { deleteSelected, duplicateSelected, nudge, turnSelected } from './commands';
import { readingOf, type UniverseEditor } from './editor';

/** Returns the keys of the view, as listed in `docs/how-to/make-a-universe.md`. */
export const keysOf = (editor: UniverseEditor): KeyActs => ({
  modes: ['move', 'turn', 'size'],
  nudge: (along, aside, up, factor) => nudge(editor, along, aside, up, factor),
  turn: (sense) => turnSelected(editor, sense * TURN_STEP),
  remove: () => deleteSelected(editor),
  duplicate: () => duplicateSelected(editor),
  all: () => readingOf(editor).universe?.things.map(({ key }) => key) ?? [],
  others: {
    w: ({ store }) =>
      store.setState(({ tool }) => ({ tool: tool === 'wall' ? 'select' : 'wall', placing: null })),
  },
});
