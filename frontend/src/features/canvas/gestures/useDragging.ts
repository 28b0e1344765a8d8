import { useReactFlow } from '@xyflow/react';
import { useCallback, useEffect, useRef, useState, type RefObject } from 'react';
import { freshId, subtreeOf, topmost, type NodeId } from '@/model/diagram';
import { insertFragment, fragmentOf, moveNodes, setPosition, withFreshIds } from '@/model/edits';
import { hasRoom } from '@/model/rules';
import { isSamePlace, slotFinder, type Slot, type SlotFinder } from '@/model/slots';
import { change } from '@/store/project/edits/blocks';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { cancellable, releaseMouse } from '@/ui/cancellable';
import { BlockDrag } from './draggedBlocks';
import type { BlockNode } from '../flow';
import type { TreeOnCanvas } from '../useTree';

/** The distance in px below which a movement counts as a click, since hands tremble. */
const DEAD_ZONE = 6;

/** The values that are computed once at the start of a drag. */
interface Grip {
  readonly hand: BlockDrag;
  /** The dragged blocks that are below no other dragged block, in execution order. */
  readonly tops: readonly NodeId[];
  readonly layout: unknown;
  readonly findSlot: SlotFinder;
  /** The last position of the pointer, for a key that is pressed while the pointer rests. */
  last: Step | null;
  /** Stops listening for Escape and the Alt key. */
  readonly end: () => void;
}

/** The offset of the block from its place, and the position of the pointer in the window. */
interface Step {
  readonly dx: number;
  readonly dy: number;
  readonly x: number;
  readonly y: number;
}

type DragEvent = MouseEvent | TouchEvent | React.MouseEvent;

const pointerOf = (event: DragEvent): { readonly clientX: number; readonly clientY: number } | undefined =>
  'touches' in event ? event.touches[0] : event;

/** Calls `onAlt` when the Alt key is pressed or released; returns a function that stops it. */
function watchAlt(canvas: HTMLElement, onAlt: (isDown: boolean) => void): () => void {
  const listening = new AbortController();
  const view = canvas.ownerDocument.defaultView ?? window;
  for (const type of ['keydown', 'keyup'] as const) {
    const onKey = (event: KeyboardEvent): void => {
      if (event.key !== 'Alt') return;
      // Otherwise the browser's menu would take the focus.
      event.preventDefault();
      onAlt(type === 'keydown');
    };
    view.addEventListener(type, onKey, { signal: listening.signal });
  }
  return () => listening.abort();
}

/**
 * Returns the handlers that drag blocks into a slot of the tree or to a free position. Alt copies the blocks;
 * Escape cancels the drag.
 */
export function useDragging(tree: TreeOnCanvas, canvas: RefObject<HTMLElement | null>) {
  const flow = useReactFlow();
  const grip = useRef<Grip | null>(null);
  const [held, setHeld] = useState<string | null>(null);
  const { diagram, shown, layout, vocabulary } = tree;

  const isCancelled = useRef(false);

  const letGo = useCallback(() => {
    grip.current?.end();
    grip.current?.hand.letGo();
    grip.current = null;
  }, []);
  useEffect(() => letGo, [letGo]);

  const putDown = useCallback(() => {
    letGo();
    setHeld(null);
    setEditor({ slot: null });
  }, [letGo]);

  /**
   * Returns whether blocks may be dropped into a slot. A copy needs room beside the present children, whereas
   * a moved block leaves its old place first.
   */
  const allows = useCallback(
    (slot: Slot, tops: readonly NodeId[], isCopy: boolean): boolean =>
      isCopy ? hasRoom(diagram, slot.parent, vocabulary, tops.length) : !isSamePlace(diagram, tops, slot),
    [diagram, vocabulary],
  );

  const follow = useCallback(
    ({ hand, tops, findSlot }: Grip, { dx, dy, x, y }: Step, isCopy: boolean) => {
      hand.moveBy(dx, dy, isCopy);
      const pointer = flow.screenToFlowPosition({ x, y });
      const slot = Math.hypot(dx, dy) > DEAD_ZONE ? findSlot(pointer.x, pointer.y) : null;
      const next = slot && allows(slot, tops, isCopy) ? slot : null;
      const shown = useEditorStore.getState().slot;
      const same =
        next?.parent === shown?.parent && next?.index === shown?.index && next?.kind === shown?.kind;
      if (!same) setEditor({ slot: next });
    },
    [allows, flow],
  );

  const take = useCallback(
    (node: BlockNode): Grip | null => {
      const known = grip.current;
      if (known?.hand.holds === node.id && known.layout === layout) return known;
      letGo();
      const element = canvas.current;
      if (!element) return null;
      const { selection } = useProjectStore.getState();
      const tops =
        selection.length > 1 && selection.includes(node.id) ? topmost(diagram, selection) : [node.id];
      const ids = new Set(tops.flatMap((top) => subtreeOf(shown.diagram, top)));
      const endGesture = cancellable(element, null, {
        onCancel: () => {
          isCancelled.current = true;
          putDown();
          releaseMouse(element.ownerDocument);
        },
      });
      const endAlt = watchAlt(element, (isDown) => {
        if (taken.last) follow(taken, taken.last, isDown);
      });
      const taken: Grip = {
        hand: new BlockDrag(element, node.id, new Set(tops), ids),
        tops,
        layout,
        findSlot: slotFinder({ diagram, layout, vocabulary, moving: tops }),
        last: null,
        end: () => {
          endAlt();
          endGesture();
        },
      };
      setHeld(node.id);
      return (grip.current = taken);
    },
    [diagram, shown, layout, vocabulary, canvas, letGo, putDown, follow],
  );

  const onDragStart = useCallback(() => {
    isCancelled.current = false;
  }, []);

  const onDrag = useCallback(
    (event: DragEvent, node: BlockNode) => {
      const origin = layout.positions[node.id];
      const pointer = pointerOf(event);
      if (!origin || !pointer || isCancelled.current) return;
      const taken = take(node);
      if (!taken) return;
      taken.last = {
        dx: node.position.x - origin.x,
        dy: node.position.y - origin.y,
        x: pointer.clientX,
        y: pointer.clientY,
      };
      follow(taken, taken.last, event.altKey);
    },
    [layout, take, follow],
  );

  const onDrop = useCallback(
    (event: DragEvent, node: BlockNode) => {
      const found = useEditorStore.getState().slot;
      const origin = layout.positions[node.id];
      const tops = grip.current?.tops;
      putDown();
      if (!origin || !tops) return;
      const [dx, dy] = [node.position.x - origin.x, node.position.y - origin.y];
      if (Math.hypot(dx, dy) <= DEAD_ZONE) return;
      // The key may have changed since the last move of the pointer.
      const slot = found && allows(found, tops, event.altKey) ? found : null;
      const place = slot && ({ at: 'child', parent: slot.parent, index: slot.index } as const);
      if (event.altKey) {
        const copy = withFreshIds(fragmentOf(diagram, tops), (taken) =>
          freshId({ ...diagram.nodes, ...taken }),
        );
        const free = { at: 'draft', position: [node.position.x, node.position.y] } as const;
        change('duplicate', [insertFragment(copy, place ?? free)], { select: copy.tops });
      } else if (place) {
        change('move', [moveNodes(tops, place)], { select: tops });
      } else {
        const recipes = tops.map((top) => {
          const box = layout.positions[top];
          return setPosition(top, [(box?.x ?? 0) + dx, (box?.y ?? 0) + dy]);
        });
        change('place', recipes, { select: tops });
      }
    },
    [diagram, layout, putDown, allows],
  );

  return { held, onDragStart, onDrag, onDrop };
}
