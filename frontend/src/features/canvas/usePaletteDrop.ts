import { useReactFlow } from '@xyflow/react';
import { useCallback, type DragEvent } from 'react';
import { slotAt } from '@/model/slots';
import { addAt } from '@/store/project/commands';
import { setEditor, useEditorStore } from '@/store/project/editor';
import type { TreeOnCanvas } from './useTree';

/** New blocks dragged in from the palette: the same slots and marks as for blocks of the tree. */
export function usePaletteDrop({ diagram, layout, vocabulary }: TreeOnCanvas) {
  const flow = useReactFlow();

  const onDragOver = useCallback(
    (event: DragEvent) => {
      if (!useEditorStore.getState().dragged) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = 'copy';
      const { x, y } = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
      setEditor({ slot: slotAt({ diagram, layout, vocabulary }, x, y) });
    },
    [diagram, layout, vocabulary, flow],
  );

  const onDragLeave = useCallback((event: DragEvent) => {
    if (!event.currentTarget.contains(event.relatedTarget as Node | null)) setEditor({ slot: null });
  }, []);

  const onDrop = useCallback(
    (event: DragEvent) => {
      const { dragged } = useEditorStore.getState();
      if (!dragged) return;
      event.preventDefault();
      const { x, y } = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
      const slot = slotAt({ diagram, layout, vocabulary }, x, y);
      setEditor({ dragged: null, slot: null });
      if (slot) addAt(dragged, { at: 'child', parent: slot.parent, index: slot.index });
      else if (diagram.root === null) addAt(dragged, { at: 'root' });
      else addAt(dragged, { at: 'draft', position: [Math.round(x - 70), Math.round(y - 22)] });
    },
    [diagram, layout, vocabulary, flow],
  );

  return { onDragOver, onDragLeave, onDrop };
}
