import { BaseEdge, type EdgeProps } from '@xyflow/react';
import { memo } from 'react';
import { liveKey, pastOf } from '@/store/project/live';
import { useShownLive } from '@/store/moment/store';
import { elbow } from '@/ui/shapes';
import { useDraggedBlocks } from './gestures/draggedBlocks';
import type { TreeEdge as TreeEdgeType } from './flow';
import classes from './TreeEdge.module.css';

function TreeEdgeView(props: EdgeProps<TreeEdgeType>) {
  const { target, data, sourceX, sourceY, targetX, targetY, selected } = props;
  const key = liveKey(data?.tree ?? '', data?.node ?? target);
  const status = useShownLive((state) => state.statuses.get(key) ?? 'IDLE');
  const past = useShownLive((state) => pastOf(state, key));
  const dx = useDraggedBlocks((state) => (state.tops.has(target) ? state.dx : 0));
  const dy = useDraggedBlocks((state) => (state.tops.has(target) ? state.dy : 0));
  return (
    <g
      className={classes['edge']}
      data-status={status}
      data-past={past}
      data-selected={selected || undefined}
    >
      <BaseEdge
        path={elbow(sourceX, sourceY, targetX + dx, targetY + dy, data?.isHorizontal ?? false)}
        interactionWidth={18}
      />
    </g>
  );
}

export const TreeEdge = memo(TreeEdgeView);
