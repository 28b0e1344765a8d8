import { BaseEdge, type EdgeProps } from '@xyflow/react';
import { memo } from 'react';
import { usePaintedStatus, write, type ShownStatus } from '@/store/moment/statusPainter';
import { liveKey } from '@/store/project/live';
import { elbow } from '@/ui/shapes';
import { useDraggedBlocks } from './gestures/draggedBlocks';
import type { TreeEdge as TreeEdgeType } from './flow';
import classes from './TreeEdge.module.css';

function paint(edge: Element, { status, past }: ShownStatus): void {
  write(edge, 'data-status', status);
  write(edge, 'data-past', past);
}

function TreeEdgeView(props: EdgeProps<TreeEdgeType>) {
  const { target, data, sourceX, sourceY, targetX, targetY, selected } = props;
  const key = liveKey(data?.tree ?? '', data?.node ?? target);
  const root = usePaintedStatus<SVGGElement>(key, paint);
  const dx = useDraggedBlocks((state) => (state.tops.has(target) ? state.dx : 0));
  const dy = useDraggedBlocks((state) => (state.tops.has(target) ? state.dy : 0));
  return (
    <g ref={root} className={classes['edge']} data-selected={selected || undefined}>
      <BaseEdge
        path={elbow(sourceX, sourceY, targetX + dx, targetY + dy, data?.isHorizontal ?? false)}
        interactionWidth={18}
      />
    </g>
  );
}

export const TreeEdge = memo(TreeEdgeView);
