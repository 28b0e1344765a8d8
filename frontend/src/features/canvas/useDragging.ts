import { useReactFlow } from '@xyflow/react';
import { useCallback, useState } from 'react';
import { subtreeOf, topmost } from '@/model/diagram';
import { insertFragment, fragmentOf, moveNode, setPosition, withFreshIds } from '@/model/edits';
import { freshId } from '@/model/diagram';
import { isSamePlace, slotAt } from '@/model/slots';
import { change } from '@/store/project/commands';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import type { BlockNode, Dragged } from './flow';
import type { TreeOnCanvas } from './useTree';

/** Below this a press is a click: hands tremble. */
const DEAD_ZONE = 6;

/** Moving blocks by hand: into a slot of the tree, or to a position of its own. Alt copies. */
export function useDragging(tree: TreeOnCanvas) {
  const flow = useReactFlow();
  const [dragged, setDragged] = useState<Dragged | null>(null);
  const { diagram, layout, vocabulary } = tree;

  const onDrag = useCallback(
    (event: MouseEvent | TouchEvent | React.MouseEvent, node: BlockNode) => {
      const origin = layout.positions[node.id];
      if (!origin || !('clientX' in event)) return;
      const { selection } = useProjectStore.getState();
      const tops =
        selection.length > 1 && selection.includes(node.id) ? topmost(diagram, selection) : [node.id];
      const [dx, dy] = [node.position.x - origin.x, node.position.y - origin.y];
      setDragged((held) => ({
        ids: held?.ids.has(node.id) ? held.ids : new Set(tops.flatMap((top) => subtreeOf(diagram, top))),
        dx,
        dy,
      }));
      const pointer = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
      const far = Math.hypot(dx, dy) > DEAD_ZONE;
      const moving = event.altKey ? undefined : node.id;
      const slot = far
        ? slotAt({ diagram, layout, vocabulary, moving: moving ?? node.id }, pointer.x, pointer.y)
        : null;
      const stays = slot !== null && !event.altKey && isSamePlace(diagram, node.id, slot);
      const next = stays ? null : slot;
      const shown = useEditorStore.getState().slot;
      const same =
        next?.parent === shown?.parent && next?.index === shown?.index && next?.kind === shown?.kind;
      if (!same) setEditor({ slot: next });
    },
    [diagram, layout, vocabulary, flow],
  );

  const onDrop = useCallback(
    (event: MouseEvent | TouchEvent | React.MouseEvent, node: BlockNode) => {
      const { slot } = useEditorStore.getState();
      const origin = layout.positions[node.id];
      setDragged(null);
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
    [diagram, layout],
  );

  return { dragged, onDrag, onDrop };
}
