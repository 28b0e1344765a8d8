import { useProjectStore } from '@/store/project';

/** Keys for blocks count only while the canvas has the focus: elsewhere they edit text. */
export const isOnCanvas = (): boolean => document.activeElement?.closest('[data-testid="canvas"]') !== null;

/** Returns whether the tree itself is visible, and not its text. */
export const isTreeInFront = (): boolean =>
  document
    .querySelector(
      `[data-testid="canvas"][data-tree="${CSS.escape(useProjectStore.getState().activeTree ?? '')}"]`,
    )
    ?.checkVisibility() === true;
