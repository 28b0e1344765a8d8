import { BaseEdge, type EdgeProps } from '@xyflow/react';
import { memo } from 'react';
import { liveKey, useLiveStore } from '@/store/project/live';
import type { TreeEdge as TreeEdgeType } from './flow';
import classes from './TreeEdge.module.css';

const RADIUS = 12;

/** An orthogonal line with round corners, bending halfway: children of one parent share the bend. */
function elbow(x1: number, y1: number, x2: number, y2: number, isHorizontal: boolean): string {
  if (isHorizontal) {
    const middle = x1 + Math.min(28, (x2 - x1) / 2);
    const r = Math.min(RADIUS, Math.abs(y2 - y1) / 2, Math.abs(x2 - x1) / 2);
    const turn = y2 > y1 ? 1 : -1;
    if (r < 1) return `M${x1} ${y1}L${x2} ${y2}`;
    return `M${x1} ${y1}H${middle - r}Q${middle} ${y1} ${middle} ${y1 + turn * r}V${y2 - turn * r}Q${middle} ${y2} ${middle + r} ${y2}H${x2}`;
  }
  const middle = y1 + Math.min(28, (y2 - y1) / 2);
  const r = Math.min(RADIUS, Math.abs(x2 - x1) / 2, Math.abs(y2 - y1) / 2);
  const turn = x2 > x1 ? 1 : -1;
  if (r < 1) return `M${x1} ${y1}L${x2} ${y2}`;
  return `M${x1} ${y1}V${middle - r}Q${x1} ${middle} ${x1 + turn * r} ${middle}H${x2 - turn * r}Q${x2} ${middle} ${x2} ${middle + r}V${y2}`;
}

function TreeEdgeView(props: EdgeProps<TreeEdgeType>) {
  const { id, target, data, sourceX, sourceY, targetX, targetY, selected } = props;
  const key = liveKey(data?.tree ?? '', target);
  const status = useLiveStore((state) => state.statuses.get(key) ?? 'IDLE');
  return (
    <g className={classes['edge']} data-status={status} data-selected={selected || undefined}>
      <BaseEdge
        id={id}
        path={elbow(sourceX, sourceY, targetX, targetY, data?.isHorizontal ?? false)}
        interactionWidth={18}
      />
    </g>
  );
}

export const TreeEdge = memo(TreeEdgeView);
