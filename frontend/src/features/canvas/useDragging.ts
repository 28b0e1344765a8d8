import { useReactFlow } from '@xyflow/react';
import { useCallback, useEffect, useRef, useState, type RefObject } from 'react';
import { subtreeOf, topmost } from '@/model/diagram';
import { insertFragment, fragmentOf, moveNode, setPosition, withFreshIds } from '@/model/edits';
import { freshId } from '@/model/diagram';
import { isSamePlace, slotFinder, type SlotFinder } from '@/model/slots';
import { change } from '@/store/project/commands';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { Hand } from './carrying';
import type { BlockNode } from './flow';
import type { TreeOnCanvas } from './useTree';

/** Below this a press is a click: hands tremble. */
const DEAD_ZONE = 6;

/** What is worked out once when a block is taken, for all steps of the hand. */
interface Grip {
  readonly hand: Hand;
  readonly layout: unknown;
  readonly findSlot: SlotFinder;
}

/** Moving blocks by hand: into a slot of the tree, or to a position of its own. Alt copies. */
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
      const hand = new Hand(canvas.current, node.id, new Set(tops), ids);
      const findSlot = slotFinder({ diagram, layout, vocabulary, moving: node.id });
      setHeld(node.id);
      return (grip.current = { hand, layout, findSlot });
    },
    [diagram, shown, layout, vocabulary, canvas],
  );

  const letGo = useCallback(() => {
    grip.current?.hand.letGo();
    grip.current = null;
  }, []);
  useEffect(() => letGo, [letGo]);

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
      const stays = slot !== null && !event.altKey && isSamePlace(diagram, node.id, slot);
      const next = stays ? null : slot;
      const shown = useEditorStore.getState().slot;
      const same =
        next?.parent === shown?.parent && next?.index === shown?.index && next?.kind === shown?.kind;
      if (!same) setEditor({ slot: next });
    },
    [diagram, layout, take, flow],
  );

  const onDrop = useCallback(
    (event: MouseEvent | TouchEvent | React.MouseEvent, node: BlockNode) => {
      const { slot } = useEditorStore.getState();
      const origin = layout.positions[node.id];
      letGo();
      setHeld(null);
      setEditor({ slot: null });
      if (!origin) return;
      const { selection } = useProjectStore.getState();
      const tops = selection.includes(node.id) ? topmost(diagram, selection) : [node.id];
      const [dx, dy] = [node.position.x - origin.x, node.position.y - origin.y];
      if (Math.hypot(dx, dy) <= DEAD_ZONE) return;
      if (event.altKey) {
        const copy = withFreshIds(fragmentOf(diagram, tops), (taken) =>
          freshId({ ...diagram.nodes, ...taken }),
        );
        const place = slot
          ? ({ at: 'child', parent: slot.parent, index: slot.index } as const)
          : ({ at: 'draft', position: [node.position.x, node.position.y] } as const);
        change('duplicate', [insertFragment(copy, place)], { select: copy.tops });
      } else if (slot) {
        const recipes = tops.map((top) =>
          moveNode(top, { at: 'child', parent: slot.parent, index: slot.index }),
        );
        // Each goes before the one that was put there first: from the last to the first.
        change('move', recipes.reverse(), { select: tops });
      } else {
        const recipes = tops.map((top) => {
          const box = layout.positions[top];
          return setPosition(top, [(box?.x ?? 0) + dx, (box?.y ?? 0) + dy]);
        });
        change('place', recipes, { select: tops });
      }
    },
    [diagram, layout, letGo],
  );

  return { held, onDrag, onDrop };
}
