import { useStoreApi } from '@xyflow/react';
import { useCallback, useRef, type MouseEvent } from 'react';
import { useProjectStore } from '@/store/project';
import { cancellable } from '@/ui/cancellable';

/** Returns the pointer of an event, which React Flow types as a mouse event. */
const pointerIdOf = ({ nativeEvent }: MouseEvent): number | null =>
  'pointerId' in nativeEvent ? (nativeEvent.pointerId as number) : null;

/**
 * Returns the handlers of the selection rectangle, which selects the blocks inside; Escape restores the
 * selection from before.
 */
export function useBoxSelection(treeId: string) {
  const store = useStoreApi();
  const before = useRef<readonly string[]>([]);

  /** Records the selection, since React Flow clears it before it calls `onSelectionStart`. */
  const onPress = useCallback(() => {
    const { activeTree, selection } = useProjectStore.getState();
    before.current = activeTree === treeId ? selection : [];
  }, [treeId]);

  const onSelectionStart = useCallback(
    (event: MouseEvent) => {
      const pane = event.currentTarget;
      const pointerId = pointerIdOf(event);
      cancellable(pane, pointerId, {
        onCancel: () => {
          // At this event React Flow ends its own work: the view stops following the pointer, and the next
          // click is ignored.
          if (pointerId !== null && pane.hasPointerCapture(pointerId))
            pane.dispatchEvent(new PointerEvent('pointercancel', { pointerId, bubbles: true }));
          pane.dispatchEvent(new window.MouseEvent('click', { bubbles: true }));
          store.setState({ userSelectionActive: false, userSelectionRect: null });
          useProjectStore.getState().select(treeId, [...before.current]);
        },
      });
    },
    [store, treeId],
  );

  return { onPress, onSelectionStart };
}
