import { useProjectStore } from '@/store/project';

/**
 * Returns whether the canvas has the focus: only then do keys apply to blocks, since elsewhere they edit
 * text.
 */
export const isOnCanvas = (): boolean => document.activeElement?.closest('[data-testid="canvas"]') !== null;

/** Returns whether the drawing of the active tree is visible, and not only its text. */
export const isTreeInFront = (): boolean =>
  document
    .querySelector(
      `[data-testid="canvas"][data-tree="${CSS.escape(useProjectStore.getState().activeTree ?? '')}"]`,
    )
    ?.checkVisibility() === true;
