import { useEffect } from 'react';
import { useStore } from 'zustand';
import { useUndoTarget } from '@/commands/undo';
import { useProjectStore } from '@/store/project';
import { useTabs } from '@/workspace/tabs';
import { isReadOnly, type Editor } from './editing';
import { isImportOf, travelOrUndoImport, useImported } from './imported';

/** Makes the page's undo and redo act on this editor while its document is in front. */
export function useUndoInFront(editor: Editor): void {
  const isInFront = useTabs(({ front }) => front?.kind === 'file' && front.path === editor.path);
  const canUndo = useStore(editor.store, ({ undoStack }) => undoStack.past.length > 0);
  const canRedo = useStore(editor.store, ({ undoStack }) => undoStack.future.length > 0);
  const step = useImported((imported) => imported.step);
  const isImported = useProjectStore(() => isImportOf(step, editor.path));
  useEffect(() => {
    if (!isInFront) return;
    const target = {
      canUndo: (canUndo || isImported) && !isReadOnly(),
      canRedo: canRedo && !isReadOnly(),
      travel: (direction: 'undo' | 'redo') => travelOrUndoImport(editor, direction),
    };
    useUndoTarget.setState({ target });
    return () => {
      if (useUndoTarget.getState().target === target) useUndoTarget.setState({ target: null });
    };
  }, [editor, isInFront, canUndo, canRedo, isImported]);
}
