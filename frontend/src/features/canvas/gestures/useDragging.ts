import { useReactFlow } from '@xyflow/react';
import { useCallback, useEffect, useRef, useState, type RefObject } from 'react';
import { freshId, subtreeOf, topmost, type NodeId } from '@/model/diagram';
import { insertFragment, fragmentOf, moveNodes, setPosition, withFreshIds } from '@/model/edits';
import { hasRoom } from '@/model/rules';
import { isSamePlace, slotFinder, type Slot, type SlotFinder } from '@/model/slots';
import { change } from '@/store/project/edits/blocks';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { BlockDrag } from './draggedBlocks';
import type { BlockNode } from '../flow';
import type { TreeOnCanvas } from '../useTree';

/** A smaller movement counts as a click, since hands tremble. */
const DEAD_ZONE = 6;

/** Values that are computed once at the start of a drag. */
interface Grip {
  readonly hand: BlockDrag;
  /** The dragged blocks that are below no other dragged block, in execution order. */
  readonly tops: readonly NodeId[];
  readonly layout: unknown;
  readonly findSlot: SlotFinder;
}

/** Drags blocks into a slot of the tree or to a free position. Alt copies them. */
export function useDragging(tree: TreeOnCanvas, canvas: RefObject<HTMLElement | null>) {
  const flow = useReactFlow();
  const grip = useRef<Grip | null>(null);
  const [held, setHeld] = useState<string | null>(null);
  const { diagram, shown, layout, vocabulary } = tree;

  const take = useCallback(
    (node: BlockNode): Grip | null => {
      const known = grip.current;
      if (known?.hand.holds === node.id && known.layout === layout) return known;
      known?.hand.letGo();
      if (!canvas.current) return null;
      const { selection } = useProjectStore.getState();
      const tops =
        selection.length > 1 && selection.includes(node.id) ? topmost(diagram, selection) : [node.id];
      const ids = new Set(tops.flatMap((top) => subtreeOf(shown.diagram, top)));
      const hand = new BlockDrag(canvas.current, node.id, new Set(tops), ids);
      const findSlot = slotFinder({ diagram, layout, vocabulary, moving: tops });
      setHeld(node.id);
      return (grip.current = { hand, tops, layout, findSlot });
    },
    [diagram, shown, layout, vocabulary, canvas],
  );

  const letGo = useCallback(() => {
    grip.current?.hand.letGo();
    grip.current = null;
  }, []);
  useEffect(() => letGo, [letGo]);

  /** A copy is added to the children that are there; a moved block leaves its place first. */
  const allows = useCallback(
    (slot: Slot, tops: readonly NodeId[], isCopy: boolean): boolean =>
      isCopy ? hasRoom(diagram, slot.parent, vocabulary, tops.length) : !isSamePlace(diagram, tops, slot),
    [diagram, vocabulary],
  );

  const onDrag = useCallback(
    (event: MouseEvent | TouchEvent | React.MouseEvent, node: BlockNode) => {
      const origin = layout.positions[node.id];
      if (!origin || !('clientX' in event)) return;
      const taken = take(node);
      if (!taken) return;
      const [dx, dy] = [node.position.x - origin.x, node.position.y - origin.y];
      taken.hand.moveBy(dx, dy);
      const pointer = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
      const far = Math.hypot(dx, dy) > DEAD_ZONE;
      const slot = far ? taken.findSlot(pointer.x, pointer.y) : null;
      const next = slot && allows(slot, taken.tops, event.altKey) ? slot : null;
      const shown = useEditorStore.getState().slot;
      const same =
        next?.parent === shown?.parent && next?.index === shown?.index && next?.kind === shown?.kind;
      if (!same) setEditor({ slot: next });
    },
    [layout, take, allows, flow],
  );

  const onDrop = useCallback(
    (event: MouseEvent | TouchEvent | React.MouseEvent, node: BlockNode) => {
      const found = useEditorStore.getState().slot;
      const origin = layout.positions[node.id];
      const tops = grip.current?.tops ?? [node.id];
      letGo();
      setHeld(null);
      setEditor({ slot: null });
      if (!origin) return;
      const [dx, dy] = [node.position.x - origin.x, node.position.y - origin.y];
      if (Math.hypot(dx, dy) <= DEAD_ZONE) return;
      // The key may have been released, or pressed, since the last move of the pointer.
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
    [diagram, layout, letGo, allows],
  );

  return { held, onDrag, onDrop };
}
