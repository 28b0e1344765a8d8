import { useReactFlow } from '@xyflow/react';
import { useCallback, useRef, type DragEvent } from 'react';
import { slotFinder, type Slot, type SlotFinder } from '@/model/slots';
import { addAt } from '@/store/project/edits/blocks';
import { setEditor, useEditorStore } from '@/store/project/editor';
import type { TreeOnCanvas } from '../useTree';

/**
 * Returns the handlers for new blocks dropped from the palette, with the same slots and marks as for blocks
 * of the tree.
 */
export function usePaletteDrop({ diagram, layout, vocabulary }: TreeOnCanvas) {
  const flow = useReactFlow();
  const finder = useRef<{ readonly of: unknown; readonly find: SlotFinder } | null>(null);

  const slotUnder = useCallback(
    ({ x, y }: { x: number; y: number }): Slot | null => {
      if (finder.current?.of !== layout)
        finder.current = { of: layout, find: slotFinder({ diagram, layout, vocabulary }) };
      return finder.current.find(x, y);
    },
    [diagram, layout, vocabulary],
  );

  const onDragOver = useCallback(
    (event: DragEvent) => {
      if (!useEditorStore.getState().dragged) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = 'copy';
      const slot = slotUnder(flow.screenToFlowPosition({ x: event.clientX, y: event.clientY }));
      const shown = useEditorStore.getState().slot;
      if (slot?.parent !== shown?.parent || slot?.index !== shown?.index || slot?.kind !== shown?.kind)
        setEditor({ slot });
    },
    [slotUnder, flow],
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
      const slot = slotUnder({ x, y });
      setEditor({ dragged: null, slot: null });
      if (slot) addAt(dragged, { at: 'child', parent: slot.parent, index: slot.index });
      else if (diagram.root === null) addAt(dragged, { at: 'root' });
      else addAt(dragged, { at: 'draft', position: [Math.round(x - 70), Math.round(y - 22)] });
    },
    [diagram, slotUnder, flow],
  );

  return { onDragOver, onDragLeave, onDrop };
}
