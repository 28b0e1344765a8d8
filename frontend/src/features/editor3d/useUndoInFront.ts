import { useEffect } from 'react';
import { useStore } from 'zustand';
import { useUndoTarget } from '@/commands/undo';
import { useTabs } from '@/workspace/tabs';
import { isReadOnly, travel, type Editor } from './editing';

/** Makes the page's undo and redo act on this editor while its document is in front. */
export function useUndoInFront(editor: Editor): void {
  const isInFront = useTabs(({ front }) => front?.kind === 'file' && front.path === editor.path);
  const canUndo = useStore(editor.store, ({ undoStack }) => undoStack.past.length > 0);
  const canRedo = useStore(editor.store, ({ undoStack }) => undoStack.future.length > 0);
  useEffect(() => {
    if (!isInFront) return;
    const target = {
      canUndo: canUndo && !isReadOnly(),
      canRedo: canRedo && !isReadOnly(),
      travel: (direction: 'undo' | 'redo') => travel(editor, direction),
    };
    useUndoTarget.setState({ target });
    return () => {
      if (useUndoTarget.getState().target === target) useUndoTarget.setState({ target: null });
    };
  }, [editor, isInFront, canUndo, canRedo]);
}
