import { useEffect, useRef, useState, type PointerEvent, type RefObject } from 'react';
import { topmost, type Diagram, type NodeId } from '@/model/diagram';
import { moveNodes } from '@/model/edits';
import { outlineSlot, type OutlineLine, type OutlineSlot } from '@/model/outline';
import { isSamePlace } from '@/model/slots';
import { useProjectStore } from '@/store/project';
import { change } from '@/store/project/edits/blocks';
import { cancellable } from '@/ui/cancellable';

/** The distance in px below which a movement counts as a click. */
const CLICK_PX = 5;

/**
 * Returns the blocks that a drag moves: the selected ones if the pressed block is one of them, otherwise the
 * pressed one.
 */
function movedBy(diagram: Diagram, id: NodeId): readonly NodeId[] {
  const { selection } = useProjectStore.getState();
  return selection.length > 1 && selection.includes(id) ? topmost(diagram, selection) : [id];
}

/**
 * Returns the handlers that drag lines of the outline to another place of the tree; Escape cancels the drag.
 */
export function useRowDrag(
  list: RefObject<HTMLElement | null>,
  diagram: Diagram | undefined,
  rows: readonly OutlineLine[],
  rowPx: number,
) {
  const [slot, setSlot] = useState<OutlineSlot | null>(null);
  const end = useRef<() => void>(() => undefined);
  /** Whether the next click only ends a drag. */
  const wasDragged = useRef(false);
  useEffect(() => () => end.current(), []);

  const slotAt = (clientY: number, moving: readonly NodeId[]): OutlineSlot | null => {
    if (!list.current || !diagram) return null;
    const place = (clientY - list.current.getBoundingClientRect().top) / rowPx;
    const row = rows[Math.floor(place)];
    const { vocabulary } = useProjectStore.getState();
    const found = row ? outlineSlot({ diagram, vocabulary, moving }, row, place - Math.floor(place)) : null;
    return found && !isSamePlace(diagram, moving, { ...found, kind: 'onto', mark: NO_BOX }) ? found : null;
  };

  const onPress = (event: PointerEvent, id: NodeId): void => {
    wasDragged.current = false;
    if (event.button !== 0 || event.pointerType === 'touch' || !diagram || id === diagram.root) return;
    const { clientX, clientY } = event;
    const moving = movedBy(diagram, id);
    let found: OutlineSlot | null = null;
    end.current = cancellable(event.currentTarget, event.pointerId, {
      onMove: (move) => {
        if (Math.hypot(move.clientX - clientX, move.clientY - clientY) > CLICK_PX) wasDragged.current = true;
        if (!wasDragged.current) return;
        found = slotAt(move.clientY, moving);
        setSlot(found);
      },
      onEnd: () => {
        setSlot(null);
        if (!found) return;
        const { parent, index } = found;
        change('move', [moveNodes(moving, { at: 'child', parent, index })], { select: moving });
      },
      onCancel: () => setSlot(null),
    });
  };

  return { slot, onPress, wasDragged };
}

const NO_BOX = { x: 0, y: 0, width: 0, height: 0 };
