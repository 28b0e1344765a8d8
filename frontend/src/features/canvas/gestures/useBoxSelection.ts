import { useStoreApi } from '@xyflow/react';
import { useCallback, useRef, type MouseEvent } from 'react';
import { useProjectStore } from '@/store/project';
import { cancellable } from '@/ui/cancellable';

/** Returns the pointer of an event of React Flow, which types it as the mouse's. */
const pointerIdOf = ({ nativeEvent }: MouseEvent): number | null =>
  'pointerId' in nativeEvent ? (nativeEvent.pointerId as number) : null;

/** Returns a frame that is drawn around blocks selects them; Escape restores what was selected before. */
export function useBoxSelection(treeId: string) {
  const store = useStoreApi();
  const before = useRef<readonly string[]>([]);

  /** React Flow forgets the selection before it calls `onSelectionStart`. */
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
          // React Flow ends its own work at these: the view that follows the pointer, and the next click.
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
