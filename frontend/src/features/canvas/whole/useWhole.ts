import { useReactFlow, useStore, type ReactFlowState } from '@xyflow/react';
import { useCallback, useEffect, useState } from 'react';
import { flushSync } from 'react-dom';
import type { NodeId } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';
import { preparedPart } from '@/ui/parts';
import type { TreeOnCanvas } from '../useTree';
import { FIT } from '../view/useViewport';
import { isTooLarge } from '../view/views';
import { useEnter } from './useEnter';

/** The picture of a whole tree: most trees are never seen from so far. */
const [WholeTree, prepareWholeTree] = preparedPart(async () => (await import('./WholeTree')).WholeTree);

export { WholeTree };

/**
 * The zoom below which a large tree is drawn as a whole, as nested boxes with names. The symbols of its blocks, all
 * that is left of them so far off, would have less than ten pixels.
 */
const WHOLE = 0.25;

type Pane = Pick<ReactFlowState, 'width' | 'height'>;

/** Whether a tree would have to be seen from so far. A tree that fits at a larger zoom can be read as it is. */
const isLarge = ({ width, height }: Pane, layout: Layout): boolean =>
  width > 0 && layout.width > 0 && Math.min(width / layout.width, height / layout.height) < WHOLE;

const useIsLarge = (layout: Layout): boolean =>
  useStore(useCallback((state: ReactFlowState) => isLarge(state, layout), [layout]));

/** Returns whether a tree is drawn as a whole now. */
export const useSeenWhole = (layout: Layout): boolean =>
  useStore(
    useCallback((state: ReactFlowState) => state.transform[2] < WHOLE && isLarge(state, layout), [layout]),
  );

interface Whole {
  /** Whether the tree is drawn as a whole. */
  readonly isWhole: boolean;
  /** Leads to a block, or to the root, where it can be read. */
  readonly enter: (id: NodeId | null, zoom?: number) => void;
}

/** Says when the canvas draws its tree as a whole, and leads from there into it. */
export function useWhole(treeId: string, { shown, layout }: TreeOnCanvas): Whole {
  const isLarge = useIsLarge(layout);
  const isFar = useSeenWhole(layout);
  const [isWished, wish] = useState(false);
  const isWhole = isFar || (isLarge && isWished);
  const flow = useReactFlow();
  const { diagram, inside } = shown;
  const onEntered = useCallback(
    (id: NodeId) => {
      // A block that is shown inside of a SubTree cannot be selected.
      if (!inside.has(id)) useProjectStore.getState().select(treeId, [id]);
    },
    [treeId, inside],
  );
  const enter = useEnter({ diagram, layout }, onEntered);
  const fit = useCallback(() => {
    // The picture comes before the view moves: from that far off, all blocks would be drawn once.
    flushSync(() => wish(true));
    void flow.fitView(FIT).finally(() => wish(false));
  }, [flow]);

  useEffect(() => {
    // What does not come now is asked for again when it is shown.
    if (isLarge) void prepareWholeTree().catch(() => undefined);
  }, [isLarge]);

  useEffect(() => {
    if (!isLarge) return;
    const go = (zoom?: number) => enter(useProjectStore.getState().selection[0] ?? null, zoom);
    return isTooLarge(treeId, { fit, enter: isWhole ? go : null });
  }, [isLarge, isWhole, treeId, enter, fit]);

  return { isWhole, enter };
}
